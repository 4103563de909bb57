/// How bodies cut triangles: where a triangle lies, and quadrature over what is left of it outside all
/// bodies, exact to the arc and to the corner (docs/numerics.md, "Cut elements").
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/base/types.hpp"
#include "fluid/geometry/convex.hpp"
#include "fluid/geometry/surface.hpp"

namespace fpi::fluid {

struct PlanePoint {
  Vec2 x;
  double weight;  ///< [m²]
};

enum class Position { outside, cut, inside };
/// Of a triangle with respect to a body. A triangle that a straight side touches counts as cut: it may have
/// to carry a side that runs along its edge.
Position position(const Corners& triangle, const Surface& surface);

/// Appends quadrature points over the triangle without the bodies, of degree 5 and better. Polygons come
/// first: they leave convex pieces. A piece that one circle bounds is mapped to the arc exactly; where
/// several circles meet, it is bisected before.
void cut_quadrature(const Corners& triangle, std::span<const Surface* const> surfaces,
                    std::vector<PlanePoint>& points);

}  // namespace fpi::fluid
