#include "grains/lattice.hpp"

#include <cmath>

namespace fpi::grains {
namespace {

/// How rows follow each other in a layer, and layers each other, over the spacing.
struct Pattern {
  double row_height, row_shift;         ///< every second row is shifted along x
  double layer_height;                  ///< of lattices in space
  double layer_shift_x, layer_shift_y;  ///< of every second layer
};

Pattern pattern_of(const std::string& kind) {
  const double third = std::sqrt(3.0);
  if (kind == "hexagonal") return {third / 2, 0.5, 0, 0, 0};
  if (kind == "hcp") return {third / 2, 0.5, std::sqrt(2.0 / 3.0), 0.5, third / 6};
  return {1, 0, 1, 0, 0};  // square, cubic
}

}  // namespace

std::vector<Vec3> lattice(const std::string& kind, const Box& box, double spacing, double margin) {
  const Pattern p = pattern_of(kind);
  const double slack = 1e-9 * spacing;  // a box that fits exactly holds its last row
  const auto fits = [&](double x, std::size_t axis) { return x <= box.upper[axis] - margin + slack; };
  std::vector<Vec3> centres;
  for (std::size_t layer = 0;; ++layer) {
    const double z =
        box.axes == 2 ? 0 : box.lower[2] + margin + static_cast<double>(layer) * p.layer_height * spacing;
    if (box.axes == 2 ? layer > 0 : !fits(z, 2)) return centres;
    const double odd_layer = static_cast<double>(layer % 2) * spacing;
    for (std::size_t row = 0;; ++row) {
      const double y = box.lower[1] + margin + static_cast<double>(row) * p.row_height * spacing +
                       odd_layer * p.layer_shift_y;
      if (!fits(y, 1)) break;
      // Shifts of half a spacing of row and layer cancel each other.
      const double shift = std::fmod(
          static_cast<double>(row % 2) * p.row_shift * spacing + odd_layer * p.layer_shift_x, spacing);
      for (std::size_t i = 0;; ++i) {
        const double x = box.lower[0] + margin + static_cast<double>(i) * spacing + shift;
        if (!fits(x, 0)) break;
        centres.push_back({x, y, z});
      }
    }
  }
}

}  // namespace fpi::grains
