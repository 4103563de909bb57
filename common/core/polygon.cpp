#include "core/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fpi {
namespace {

struct Point {
  double x, y;
};
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

/// Vertex i, counted round.
Point vertex(const std::vector<double>& v, std::size_t i) {
  const std::size_t k = 2 * (i % (v.size() / 2));
  return {v[k], v[k + 1]};
}

/// Whether q, on the line through p and r, lies between them.
bool between(Point p, Point q, Point r) { return dot(p - q, r - q) <= 0; }

/// Segments ab and cd share a point.
bool meet(Point a, Point b, Point c, Point d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && between(a, c, b)) || (d_side == 0 && between(a, d, b)) ||
         (a_side == 0 && between(c, a, d)) || (b_side == 0 && between(c, b, d));
}

/// Side b → c goes back over side a → b.
bool folds_back(Point a, Point b, Point c) { return cross(b - a, c - b) == 0 && dot(b - a, c - b) < 0; }

}  // namespace

double signed_area(const std::vector<double>& v) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < v.size() / 2; ++i)
    twice += cross(vertex(v, i) - vertex(v, 0), vertex(v, i + 1) - vertex(v, 0));
  return 0.5 * twice;
}

std::vector<double> counter_clockwise(std::vector<double> v) {
  if (signed_area(v) >= 0) return v;
  std::reverse(v.begin(), v.end());
  for (std::size_t k = 0; k < v.size(); k += 2) std::swap(v[k], v[k + 1]);
  return v;
}

std::string polygon_problem(const std::vector<double>& v) {
  if (v.size() < 6 || v.size() % 2 != 0) return "must hold x, y of three vertices or more";
  const std::size_t n = v.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = vertex(v, i), b = vertex(v, i + 1), c = vertex(v, i + 2);
    if (a.x == b.x && a.y == b.y)
      return fmt::format("must not repeat a vertex: {} and {} are the same", i, (i + 1) % n);
    if (folds_back(a, b, c))
      return fmt::format("must not fold back on itself, as it does at vertex {}", (i + 1) % n);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 2; k < n && k < i + n - 1; ++k)
      if (meet(vertex(v, i), vertex(v, i + 1), vertex(v, k), vertex(v, k + 1)))
        return fmt::format("must not cross or touch itself: the sides from vertex {} and from vertex {} meet",
                           i, k);
  return signed_area(v) == 0 ? "must enclose an area" : "";
}

}  // namespace fpi
