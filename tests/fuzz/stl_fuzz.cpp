/// STL files: what is taken is finite triangles; every refusal names the file.
#include "fuzz.hpp"
#include "stl.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fpi;
  fuzz::takes_or_refuses("wall.stl", [&] {
    const auto triangles = dem::read_stl(fuzz::text(data, size), "wall.stl").triangles;
    if (triangles.empty()) fuzz::fault("no triangle, and no word");
    for (const dem::Corners& corners : triangles)
      for (const dem::Vec3& corner : corners)
        if (!corner.allFinite()) fuzz::fault("a corner that is not finite");
  });
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() { return files(FPI_FUZZ_CORPUS "/stl"); }

std::vector<std::string> words() {
  return {"solid ", "endsolid", "facet normal 0 0 1", "outer loop\n", "vertex ", "endloop\n", "endfacet\n"};
}

}  // namespace fpi::fuzz
