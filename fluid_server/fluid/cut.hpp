/// Geometry of a circle that cuts triangles, exact to the arc: where edges are crossed, and quadrature over
/// what is left of a triangle outside all discs (numerics.md section 1, "Cut geometry").
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/types.hpp"

namespace fpi::fluid {

struct Disc {
  Vec2 centre;
  double radius;
  Vec2 at(double angle) const { return centre + radius * Vec2(std::cos(angle), std::sin(angle)); }
  double angle(const Vec2& x) const { return std::atan2(x.y() - centre.y(), x.x() - centre.x()); }
  bool contains(const Vec2& x) const { return (x - centre).squaredNorm() < radius * radius; }
};

using Corners = std::array<Vec2, 3>;

struct PlanePoint {
  Vec2 x;
  double weight;  ///< [m²]
};

/// Parameters t in [0, 1], ascending, at which the segment a + t (b − a) crosses the circle: none, one or
/// two. A point on the circle counts as outside, so that the number agrees with which ends are inside.
struct Crossings {
  int count = 0;
  std::array<double, 2> t{};
};
Crossings crossings(const Vec2& a, const Vec2& b, const Disc& disc);

enum class Position { outside, cut, inside };
/// Of a triangle with respect to a disc.
Position position(const Corners& triangle, const Disc& disc);

/// Appends quadrature points over the triangle without the discs. Pieces that one circle bounds are mapped to
/// the arc exactly, with degree 5 and better; where several circles meet, the triangle is bisected first.
void cut_quadrature(const Corners& triangle, std::span<const Disc> discs, std::vector<PlanePoint>& points);

}  // namespace fpi::fluid
