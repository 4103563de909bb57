#include "fluid/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fpi::fluid {
namespace {

constexpr double straight = 1e-10;  ///< sine of the largest angle between the parts of one side

}  // namespace

int Polygon::side_of(double parameter) const {
  const double k = std::floor(parameter);
  return static_cast<int>(k - period() * std::floor(k / period()));
}

Vec2 Polygon::at(double parameter) const {
  const auto [from, to] = side(side_of(parameter));
  return from + (parameter - std::floor(parameter)) * (to - from);
}

Vec2 Polygon::normal(double parameter) const {
  const auto [from, to] = side(side_of(parameter));
  const Vec2 along = (to - from).normalized();
  return {along.y(), -along.x()};
}

double Polygon::length(double from, double to) const {
  const auto [start, end] = side(side_of(0.5 * (from + to)));
  return (to - from) * (end - start).norm();
}

double Polygon::area() const {
  double twice = 0;
  for (int k = 0; k < size(); ++k) twice += cross(side(k).from - corners[0], side(k).to - corners[0]);
  return 0.5 * twice;
}

Vec2 Polygon::centroid() const {
  Vec2 moment = Vec2::Zero();
  for (int k = 0; k < size(); ++k) {
    const Vec2 a = side(k).from - corners[0], b = side(k).to - corners[0];
    moment += cross(a, b) / 6 * (a + b);
  }
  return corners[0] + moment / area();
}

/// A ray to the right leaves the body as often as it enters, plus once.
bool Polygon::contains(const Vec2& x) const {
  bool inside = false;
  for (int k = 0; k < size(); ++k) {
    const auto [from, to] = side(k);
    if ((from.y() > x.y()) == (to.y() > x.y())) continue;
    const bool upwards = to.y() > from.y();
    if ((cross(to - from, x - from) > 0) == upwards) inside = !inside;
  }
  return inside;
}

double Polygon::nearest(const Vec2& x) const {
  double least = std::numeric_limits<double>::infinity(), parameter = 0;
  for (int k = 0; k < size(); ++k) {
    const auto [from, to] = side(k);
    const double t = std::clamp(fluid::nearest(from, to, x), 0.0, 1.0);
    const double distance = (from + t * (to - from) - x).norm();
    if (distance >= least) continue;
    least = distance;
    parameter = k + t;
  }
  return parameter;
}

double Polygon::distance(const Vec2& x) const {
  const double distance = (at(nearest(x)) - x).norm();
  return contains(x) ? -distance : distance;
}

Polygon Polygon::moved(const Vec2& shift) const {
  Polygon out = *this;
  for (Vec2& corner : out.corners) corner += shift;
  return out;
}

Vec2 Polygon::lower() const {
  Vec2 low = corners[0];
  for (const Vec2& x : corners) low = low.cwiseMin(x);
  return low;
}

Vec2 Polygon::upper() const {
  Vec2 high = corners[0];
  for (const Vec2& x : corners) high = high.cwiseMax(x);
  return high;
}

Subdivided merge_collinear(const std::vector<Vec2>& vertices) {
  const int n = static_cast<int>(vertices.size());
  const auto is_corner = [&](int i) {
    const Vec2 before = vertices[i] - vertices[(i + n - 1) % n], after = vertices[(i + 1) % n] - vertices[i];
    return before.dot(after) <= 0 || std::abs(cross(before, after)) > straight * before.norm() * after.norm();
  };
  Subdivided out;
  std::vector<int> side(n, -1);  // vertices before the first corner lie on the last side, one turn earlier
  for (int i = 0; i < n; ++i) {
    if (is_corner(i)) out.polygon.corners.push_back(vertices[i]);
    side[i] = out.polygon.size() - 1;
  }
  const int n_sides = out.polygon.size();
  for (int i = 0; i < n && n_sides > 0; ++i) {
    const auto [from, to] = out.polygon.side((side[i] + n_sides) % n_sides);
    out.parameters.push_back(is_corner(i) ? side[i] : side[i] + nearest(from, to, vertices[i]));
  }
  return out;
}

void add_crossings(const Polygon& polygon, const Vec2& a, const Vec2& b, std::vector<double>& parameters) {
  const Vec2 d = b - a;
  const double touch = 2 * polygon.tolerance();
  for (int k = 0; k < polygon.size(); ++k) {
    const auto [p, q] = polygon.side(k);
    const Vec2 e = q - p;
    const double a_off = cross(e, a - p) / e.norm(), b_off = cross(e, b - p) / e.norm();
    for (const auto& [off, x] : {std::pair{a_off, a}, std::pair{b_off, b}}) {
      const double s = nearest(p, q, x);
      if (std::abs(off) < touch && s > 0 && s < 1) parameters.push_back(k + s);
    }
    const double p_off = cross(d, p - a), q_off = cross(d, q - a);
    if ((a_off > 0) != (b_off > 0) && (p_off > 0) != (q_off > 0))
      parameters.push_back(k + p_off / (p_off - q_off));
  }
}

void add_crossings(const Polygon& polygon, const Disc& disc, std::vector<double>& parameters) {
  for (int k = 0; k < polygon.size(); ++k) {
    const Crossings found = crossings(polygon.side(k).from, polygon.side(k).to, disc);
    for (int i = 0; i < found.count; ++i) parameters.push_back(k + found.t[i]);
  }
}

}  // namespace fpi::fluid
