#include "fluid/geometry/disc.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::fluid {

double nearest(const Vec2& a, const Vec2& b, const Vec2& x) {
  const Vec2 d = b - a;
  return d.dot(x - a) / d.squaredNorm();
}

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& x) {
  const double t = a == b ? 0.0 : std::clamp(nearest(a, b, x), 0.0, 1.0);
  return (a + t * (b - a) - x).norm();
}

Crossings crossings(const Vec2& a, const Vec2& b, const Disc& disc) {
  const bool a_inside = disc.contains(a), b_inside = disc.contains(b);
  if (a_inside && b_inside) return {};
  const double middle = nearest(a, b, disc.centre);
  const Vec2 d = b - a;
  const double missing = disc.radius * disc.radius - (a + middle * d - disc.centre).squaredNorm();
  const double half = std::sqrt(std::max(missing, 0.0) / d.squaredNorm());
  if (a_inside) return {1, {std::clamp(middle + half, 0.0, 1.0), 0}};
  if (b_inside) return {1, {std::clamp(middle - half, 0.0, 1.0), 0}};
  if (missing <= 0 || middle <= 0 || middle >= 1) return {};
  return {2, {std::max(middle - half, 0.0), std::min(middle + half, 1.0)}};
}

void add_crossings(const Disc& disc, const Vec2& a, const Vec2& b, std::vector<double>& angles) {
  const Crossings found = crossings(a, b, disc);
  for (int k = 0; k < found.count; ++k) {
    const double angle = disc.angle(a + found.t[k] * (b - a));
    angles.push_back(angle < 0 ? angle + Disc::period() : angle);
  }
}

void add_crossings(const Disc& disc, const Disc& other, std::vector<double>& angles) {
  const Vec2 d = other.centre - disc.centre;
  const double distance = d.norm();
  if (distance == 0 || distance >= disc.radius + other.radius ||
      distance <= std::abs(disc.radius - other.radius))
    return;
  const double cosine = (distance * distance + disc.radius * disc.radius - other.radius * other.radius) /
                        (2 * distance * disc.radius);
  const double middle = std::atan2(d.y(), d.x()), half = std::acos(std::clamp(cosine, -1.0, 1.0));
  for (double angle : {middle - half, middle + half})
    angles.push_back(angle - Disc::period() * std::floor(angle / Disc::period()));
}

}  // namespace fpi::fluid
