#include "grains/lattice.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "spheres.hpp"

namespace fpi::grains {
namespace {

struct Case {
  const char* kind;
  std::size_t axes;
  double solid_fraction;  ///< of touching grains without end
};

TEST(Lattice, touches_without_overlap_and_is_as_dense_as_theory_says) {
  constexpr double pi = std::numbers::pi, spacing = 2;
  const Case cases[] = {{"square", 2, pi / 4},
                        {"hexagonal", 2, pi / std::sqrt(12)},
                        {"cubic", 3, pi / 6},
                        {"hcp", 3, pi / std::sqrt(18)}};
  for (const auto& [kind, axes, solid_fraction] : cases) {
    const double side = axes == 2 ? 100 : 30;
    const Box box{.lower = {-5, 3, 0},
                  .upper = {side - 5, side + 3, axes == 2 ? 0 : side},
                  .axes = axes,
                  .periods = {}};
    std::vector<Sphere> spheres;
    double most = 0;
    for (const Vec3& centre : lattice(kind, box, spacing, 1)) {
      spheres.push_back({centre, 1});
      for (std::size_t k = 0; k < axes; ++k) {
        EXPECT_GE(centre[k] - 1, box.lower[k] - 1e-9);
        EXPECT_LE(centre[k] + 1, box.upper[k] + 1e-8);
        most = std::max(most, centre[k]);
      }
    }
    EXPECT_NEAR(narrowest_gap(spheres), 0, 1e-12) << kind;
    const double unit = axes == 2 ? pi : 4.0 / 3 * pi;
    const double found = unit * static_cast<double>(spheres.size()) / box.volume();
    EXPECT_GT(found, solid_fraction * (1 - 2 * spacing / side))
        << kind << ": a row may be missing at each side";
    EXPECT_LE(found, solid_fraction * (1 + spacing / side)) << kind;
  }
}

TEST(Lattice, a_box_that_fits_exactly_holds_its_last_row) {
  const Box box{.lower = {}, .upper = {0.5, 0.1, 0}, .axes = 2, .periods = {}};
  EXPECT_EQ(lattice("square", box, 0.1, 0.05).size(), 5u);
}

}  // namespace
}  // namespace fpi::grains
