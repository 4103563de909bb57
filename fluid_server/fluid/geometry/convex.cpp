#include "fluid/geometry/convex.hpp"

#include <algorithm>

namespace fpi::fluid {
namespace {

constexpr double round_off = 1e-12;  ///< of the triangle's size

/// Distance of x from the line of a segment, positive on its left.
double offset(const Segment& line, const Vec2& x) {
  const Vec2 d = line.to - line.from;
  return cross(d, x - line.from) / d.norm();
}

/// The part of a convex piece on the left of a line; corners nearer than `touch` are on it.
Convex left_part(const Convex& piece, const Segment& line, double touch) {
  Convex out;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const Vec2 &a = piece[k], &b = piece[(k + 1) % piece.size()];
    const double a_off = offset(line, a), b_off = offset(line, b);
    if (a_off >= -touch) out.push_back(a);
    if ((a_off > touch && b_off < -touch) || (a_off < -touch && b_off > touch))
      out.push_back(a + a_off / (a_off - b_off) * (b - a));
  }
  return out;
}

Vec2 centroid(const Convex& piece) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& x : piece) sum += x;
  return sum / static_cast<double>(piece.size());
}

/// Splits a piece by the first of the sides that passes through it, and its parts by the following ones.
void split(Convex piece, std::span<const Segment> sides, std::span<const Polygon* const> polygons,
           double touch, std::vector<Convex>& out) {
  while (!sides.empty() && !passes(sides.front(), piece, touch)) sides = sides.subspan(1);
  if (!sides.empty()) {
    const Segment line = sides.front(), back{line.to, line.from};
    split(left_part(piece, line, touch), sides.subspan(1), polygons, touch, out);
    split(left_part(piece, back, touch), sides.subspan(1), polygons, touch, out);
    return;
  }
  const Vec2 middle = centroid(piece);
  const auto holds = [&](const Polygon* polygon) { return polygon->contains(middle); };
  if (std::none_of(polygons.begin(), polygons.end(), holds)) out.push_back(std::move(piece));
}

}  // namespace

bool passes(const Segment& segment, std::span<const Vec2> convex, double margin) {
  double start = 0, end = 1;
  for (std::size_t k = 0; k < convex.size(); ++k) {
    const Vec2 &a = convex[k], &b = convex[(k + 1) % convex.size()];
    if ((b - a).squaredNorm() == 0) continue;
    const double from = offset({a, b}, segment.from) - margin, to = offset({a, b}, segment.to) - margin;
    if (from < 0 && to < 0) return false;
    if (from < 0) start = std::max(start, from / (from - to));
    if (to < 0) end = std::min(end, from / (from - to));
  }
  return start < end;
}

std::vector<Convex> outside(const Corners& triangle, std::span<const Polygon* const> polygons) {
  const double size = std::max({(triangle[1] - triangle[0]).norm(), (triangle[2] - triangle[1]).norm(),
                                (triangle[0] - triangle[2]).norm()});
  std::vector<Segment> sides;
  for (const Polygon* polygon : polygons)
    for (int k = 0; k < polygon->size(); ++k)
      if (passes(polygon->side(k), triangle, 0)) sides.push_back(polygon->side(k));
  std::vector<Convex> out;
  split({triangle.begin(), triangle.end()}, sides, polygons, round_off * size, out);
  return out;
}

}  // namespace fpi::fluid
