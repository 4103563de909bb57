/// Convex pieces of a triangle: what polygons leave of it. The lines of their sides split the triangle until
/// every piece is wholly inside or outside, so that areas are exact whatever the polygons look like.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/geometry/polygon.hpp"

namespace fpi::fluid {

using Corners = std::array<Vec2, 3>;
using Convex = std::vector<Vec2>;  ///< corners, counter-clockwise

/// True where the segment passes through the convex piece made smaller by `margin` [m] on every side (larger
/// where it is negative), so that a touch within round-off can be told from a cut.
bool passes(const Segment& segment, std::span<const Vec2> convex, double margin);

/// The parts of a triangle outside all polygons, exact to 1e-12 of its size.
std::vector<Convex> outside(const Corners& triangle, std::span<const Polygon* const> polygons);

}  // namespace fpi::fluid
