/// A disc, and its circle as a surface run through by the angle. Where a segment crosses the circle is
/// computed the same way for everyone who asks, so that neighbours agree to the bit.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

struct Disc {
  Vec2 centre;    ///< [m]
  double radius;  ///< [m]

  static constexpr double period() { return 2 * std::numbers::pi; }  ///< of the surface's parameter [rad]
  Vec2 at(double angle) const { return centre + radius * Vec2(std::cos(angle), std::sin(angle)); }
  Vec2 normal(double angle) const { return {std::cos(angle), std::sin(angle)}; }  ///< out of the disc
  double angle(const Vec2& x) const { return std::atan2(x.y() - centre.y(), x.x() - centre.x()); }
  double length(double from, double to) const { return radius * (to - from); }
  Vec2 centroid() const { return centre; }
  double area() const { return std::numbers::pi * radius * radius; }
  bool contains(const Vec2& x) const { return (x - centre).squaredNorm() < radius * radius; }
  double nearest(const Vec2& x) const { return angle(x); }  ///< parameter of the point nearest to x
  /// Signed distance of x from the circle [m], negative inside.
  double distance(const Vec2& x) const { return (x - centre).norm() - radius; }
  Vec2 lower() const { return centre - Vec2::Constant(radius); }
  Vec2 upper() const { return centre + Vec2::Constant(radius); }
  bool operator==(const Disc&) const = default;
  Disc moved(const Vec2& shift) const { return {centre + shift, radius}; }
};

/// Parameters t in [0, 1], ascending, at which the segment a + t (b − a) crosses the circle: none, one or
/// two. A point on the circle counts as outside, so that the number agrees with which ends are inside.
struct Crossings {
  int count = 0;
  std::array<double, 2> t{};
};
Crossings crossings(const Vec2& a, const Vec2& b, const Disc& disc);

/// Parameter of the point of a + t (b − a) that is nearest to x.
double nearest(const Vec2& a, const Vec2& b, const Vec2& x);
/// Distance of x from the segment from a to b, which may be a point [m].
double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& x);

/// Appends the angles in [0, 2π) at which the segment from a to b, or another circle, crosses the circle.
void add_crossings(const Disc& disc, const Vec2& a, const Vec2& b, std::vector<double>& angles);
void add_crossings(const Disc& disc, const Disc& other, std::vector<double>& angles);

}  // namespace fpi::fluid
