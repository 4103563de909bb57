/// Tables of grains: what is taken is finite with radii above zero; every refusal names the file.
#include <cmath>

#include "fuzz.hpp"
#include "grains/table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fpi;
  for (const std::size_t axes : {std::size_t{2}, std::size_t{3}})
    fuzz::takes_or_refuses("grains.csv", [&] {
      const grains::Table table = grains::read_table(fuzz::text(data, size), "grains.csv", axes);
      for (const grains::Row& row : table.rows)
        for (const double value : {row.sphere.centre[0], row.sphere.centre[1], row.sphere.centre[2],
                                   row.velocity[0], row.spin[2], 1 / row.sphere.radius})
          if (!std::isfinite(value) || !(row.sphere.radius > 0)) fuzz::fault("a row that is not finite");
    });
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() { return files(FPI_FUZZ_CORPUS "/table"); }

std::vector<std::string> words() {
  return {"x", "y", "z",  "radius", "vx",           "vy",  "vz", "spin", "spin_x",
          ",", ";", "\t", "\r\n",   "\xef\xbb\xbf", "0,5", "+",  "\"",   "#"};
}

}  // namespace fpi::fuzz
