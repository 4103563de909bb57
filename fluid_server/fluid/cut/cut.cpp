#include "fluid/cut/cut.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fluid/base/quadrature.hpp"

namespace fpi::fluid {
namespace {

constexpr int deepest = 12;       // bisections; a piece is then 1/64 of the triangle's size
constexpr int points_along = 5;   // Gauss points along the arc
constexpr int points_across = 4;  // and from it: degree 5 times the Jacobian

double twice_area(const Corners& c) { return cross(c[1] - c[0], c[2] - c[0]); }

/// The arc of a disc between two of its points, the short way.
struct Arc {
  const Disc& disc;
  double start, sweep;
  Arc(const Disc& d, const Vec2& from, const Vec2& to)
      : disc(d), start(d.angle(from)), sweep(std::remainder(d.angle(to) - start, 2 * std::numbers::pi)) {}
  Vec2 at(double s) const { return disc.at(start + s * sweep); }
  Vec2 derivative(double s) const {
    const Vec2 r = at(s) - disc.centre;
    return sweep * Vec2(-r.y(), r.x());
  }
};

Vec2 crossing_point(const Vec2& a, const Vec2& b, const Disc& disc) {
  return a + crossings(a, b, disc).t[0] * (b - a);
}

/// A is in the fluid, B and C are in the disc: x = A + t (arc(s) − A), Jacobian t (arc(s) − A) × arc'(s).
bool one_corner(const Vec2& a, const Vec2& b, const Vec2& c, const Disc& disc, std::vector<PlanePoint>& out) {
  const Arc arc(disc, crossing_point(a, b, disc), crossing_point(a, c, disc));
  const std::size_t before = out.size();
  for (const LinePoint& along : gauss_legendre(points_along)) {
    const Vec2 ray = arc.at(along.s) - a;
    const double jacobian = cross(ray, arc.derivative(along.s));
    if (jacobian < 0) {
      out.resize(before);
      return false;
    }
    for (const LinePoint& across : gauss_legendre(points_across))
      out.push_back({a + across.s * ray, along.weight * across.weight * across.s * jacobian});
  }
  return true;
}

/// A and B are in the fluid, C is in the disc: x = (1 − t)(A + s (B − A)) + t arc(s).
bool two_corners(const Vec2& a, const Vec2& b, const Vec2& c, const Disc& disc,
                 std::vector<PlanePoint>& out) {
  const Arc arc(disc, crossing_point(a, c, disc), crossing_point(b, c, disc));
  const std::size_t before = out.size();
  for (const LinePoint& along : gauss_legendre(points_along)) {
    const Vec2 on_edge = a + along.s * (b - a), on_arc = arc.at(along.s);
    const Vec2 arc_derivative = arc.derivative(along.s);
    for (const LinePoint& across : gauss_legendre(points_across)) {
      const double t = across.s;
      const double jacobian = cross((1 - t) * (b - a) + t * arc_derivative, on_arc - on_edge);
      if (jacobian < 0) {
        out.resize(before);
        return false;
      }
      out.push_back({(1 - t) * on_edge + t * on_arc, along.weight * across.weight * jacobian});
    }
  }
  return true;
}

void whole(const Corners& c, std::vector<PlanePoint>& out) {
  const double area = 0.5 * twice_area(c);
  for (const TrianglePoint& p : triangle_degree_5)
    out.push_back({p.l0 * c[0] + p.l1 * c[1] + p.l2 * c[2], p.weight * area});
}

/// Last resort at the deepest level: the rule of the whole piece, without the points that lie in a disc.
void by_points(const Corners& c, std::span<const Disc> discs, std::vector<PlanePoint>& out) {
  std::vector<PlanePoint> all;
  whole(c, all);
  for (const PlanePoint& p : all)
    if (std::none_of(discs.begin(), discs.end(), [&](const Disc& d) { return d.contains(p.x); }))
      out.push_back(p);
}

void cut(const Corners& c, std::span<const Disc> discs, int depth, std::vector<PlanePoint>& out);

/// Splits at the point x of edge k (from corner k to corner k + 1).
void split_edge(const Corners& c, int k, const Vec2& x, std::span<const Disc> discs, int depth,
                std::vector<PlanePoint>& out) {
  const Vec2 &a = c[k], &b = c[(k + 1) % 3], &opposite = c[(k + 2) % 3];
  cut({a, x, opposite}, discs, depth + 1, out);
  cut({x, b, opposite}, discs, depth + 1, out);
}

void bisect(const Corners& c, std::span<const Disc> discs, int depth, std::vector<PlanePoint>& out) {
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if ((c[(k + 1) % 3] - c[k]).squaredNorm() > (c[(longest + 1) % 3] - c[longest]).squaredNorm())
      longest = k;
  split_edge(c, longest, 0.5 * (c[longest] + c[(longest + 1) % 3]), discs, depth, out);
}

bool holds(const Corners& c, const Vec2& x) {
  return cross(c[1] - c[0], x - c[0]) > 0 && cross(c[2] - c[1], x - c[1]) > 0 &&
         cross(c[0] - c[2], x - c[2]) > 0;
}

/// As in the header, for a disc.
Position position(const Corners& c, const Disc& disc) {
  int n_inside = 0;
  for (const Vec2& x : c) n_inside += disc.contains(x);
  if (n_inside == 3) return Position::inside;
  if (n_inside > 0 || holds(c, disc.centre)) return Position::cut;
  for (int k = 0; k < 3; ++k)
    if (crossings(c[k], c[(k + 1) % 3], disc).count > 0) return Position::cut;
  return Position::outside;
}

void cut_by_one(const Corners& c, const Disc& disc, int depth, std::vector<PlanePoint>& out) {
  const std::span<const Disc> discs(&disc, 1);
  // An edge that enters and leaves the disc is split inside it, so that every edge is crossed once at most.
  for (int k = 0; k < 3; ++k) {
    const Vec2 &a = c[k], &b = c[(k + 1) % 3];
    if (crossings(a, b, disc).count == 2)
      return split_edge(c, k, a + nearest(a, b, disc.centre) * (b - a), discs, depth, out);
  }
  const std::array<bool, 3> inside{disc.contains(c[0]), disc.contains(c[1]), disc.contains(c[2])};
  const int n_inside = inside[0] + inside[1] + inside[2];
  if (n_inside == 0) {
    if (!holds(c, disc.centre)) return whole(c, out);
    for (int k = 0; k < 3; ++k) cut({c[k], c[(k + 1) % 3], disc.centre}, discs, depth + 1, out);
    return;
  }
  bool done = true;
  for (int k = 0; k < 3; ++k) {
    const Vec2 &a = c[k], &b = c[(k + 1) % 3], &d = c[(k + 2) % 3];
    if (n_inside == 2 && !inside[k]) done = one_corner(a, b, d, disc, out);
    if (n_inside == 1 && inside[(k + 2) % 3]) done = two_corners(a, b, d, disc, out);
  }
  if (!done) bisect(c, discs, depth, out);
}

void cut(const Corners& c, std::span<const Disc> discs, int depth, std::vector<PlanePoint>& out) {
  if (twice_area(c) <= 0) return;
  std::vector<Disc> cutting;
  for (const Disc& disc : discs) {
    const Position where = position(c, disc);
    if (where == Position::inside) return;
    if (where == Position::cut) cutting.push_back(disc);
  }
  if (cutting.empty())
    whole(c, out);
  else if (depth >= deepest)
    by_points(c, cutting, out);
  else if (cutting.size() == 1)
    cut_by_one(c, cutting[0], depth, out);
  else
    bisect(c, cutting, depth, out);
}

}  // namespace

Position position(const Corners& c, const Surface& surface) {
  const Polygon* polygon = surface.polygon();
  if (!polygon) return position(c, *surface.disc());
  for (int k = 0; k < polygon->size(); ++k)
    if (passes(polygon->side(k), c, -2 * surface.tolerance())) return Position::cut;
  return polygon->contains((c[0] + c[1] + c[2]) / 3) ? Position::inside : Position::outside;
}

void cut_quadrature(const Corners& triangle, std::span<const Surface* const> surfaces,
                    std::vector<PlanePoint>& points) {
  std::vector<Disc> discs;
  std::vector<const Polygon*> polygons;
  for (const Surface* surface : surfaces) {
    if (surface->disc()) discs.push_back(*surface->disc());
    if (surface->polygon()) polygons.push_back(surface->polygon());
  }
  if (polygons.empty()) return cut(triangle, discs, 0, points);
  for (const Convex& piece : outside(triangle, polygons))
    for (std::size_t k = 1; k + 1 < piece.size(); ++k)
      cut({piece[0], piece[k], piece[k + 1]}, discs, 0, points);
}

}  // namespace fpi::fluid
