#include "fluid/mesh/size_field.hpp"

#include <algorithm>
#include <limits>

#include "fluid/geometry/disc.hpp"

namespace fpi::fluid {
double distance(const scene::Refinement& region, const Vec2& x) {
  if (!region.box.empty()) {
    const auto& b = region.box;
    return (x - Vec2(std::clamp(x.x(), b[0], b[2]), std::clamp(x.y(), b[1], b[3]))).norm();
  }
  if (!region.centre.empty())
    return std::abs((x - Vec2(region.centre[0], region.centre[1])).norm() - region.radius);
  double least = std::numeric_limits<double>::infinity();
  const auto& line = region.line;
  for (std::size_t i = 0; i + 3 < line.size(); i += 2)
    least = std::min(least, distance_to_segment({line[i], line[i + 1]}, {line[i + 2], line[i + 3]}, x));
  return least;
}

double wanted_size(std::span<const scene::Refinement> refinements, const Vec2& x, double reach) {
  double size = std::numeric_limits<double>::infinity();
  for (const scene::Refinement& r : refinements)
    size = std::min(size, r.size + r.growth * std::max(0.0, distance(r, x) - reach));
  return size;
}

}  // namespace fpi::fluid
