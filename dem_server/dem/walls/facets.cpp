#include "dem/walls/facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fpi::dem {
namespace {

/// On the face the normal is the facet's own, on the side of x: it does not turn with round-off.
Nearest on_face(const Vec3& x, const Vec3& place, const Vec3& normal) {
  const double height = normal.dot(x - place);
  return {place, height < 0 ? Vec3(-normal) : normal, std::abs(height), true};
}

Nearest at_edge(const Vec3& x, const Vec3& place, const Vec3& normal) {
  const double distance = (x - place).norm();
  return {place, distance > 0 ? Vec3((x - place) / distance) : normal, distance, false};
}

Vec3 at_angle(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

Nearest nearest_of(const Plane& plane, const Vec3& x) {
  const double height = plane.normal.dot(x) - plane.offset;
  return {x - height * plane.normal, plane.normal, height, true};
}

Nearest nearest_of(const Segment& segment, const Vec3& x) {
  const double way = segment.along.dot(x - segment.from);
  const Vec3 place = segment.from + std::clamp(way, 0.0, segment.length) * segment.along;
  return way >= 0 && way <= segment.length ? on_face(x, place, segment.normal)
                                           : at_edge(x, place, segment.normal);
}

Nearest nearest_of(const Arc& arc, const Vec3& x) {
  const Vec3 from_centre = x - arc.centre;
  const double away = from_centre.norm();
  const Vec3 out = away > 0 ? Vec3(from_centre / away) : arc.middle;
  const double angle = std::atan2(arc.middle.cross(out).z(), arc.middle.dot(out));  // from the middle
  if (std::abs(angle) <= arc.half_span) return on_face(x, arc.centre + arc.radius * out, out);
  const Eigen::AngleAxisd turn(std::copysign(arc.half_span, angle), Vec3::UnitZ());
  return at_edge(x, arc.centre + arc.radius * (turn * arc.middle), out);
}

/// The nearest point of the edge from a to b; whether it is the edge's for x is for the caller to say.
Nearest on_edge(const Triangle& triangle, std::size_t edge, const Vec3& x) {
  const Vec3& a = triangle.corners[edge];
  const Vec3 along = triangle.corners[(edge + 1) % 3] - a;
  const double share = std::clamp(along.dot(x - a) / along.squaredNorm(), 0.0, 1.0);
  return at_edge(x, a + share * along, triangle.normal);
}

/// The foot of the perpendicular where it lies inside, else the nearest point of the edges that it lies
/// beyond.
Nearest nearest_of(const Triangle& triangle, const Vec3& x) {
  const auto& corners = triangle.corners;
  const auto beyond = [&](std::size_t edge) {
    const Vec3 along = corners[(edge + 1) % 3] - corners[edge];
    return along.cross(triangle.normal).dot(x - corners[edge]) > 0;
  };
  Nearest found = on_face(x, x - triangle.normal.dot(x - corners[0]) * triangle.normal, triangle.normal);
  for (std::size_t edge = 0; edge < 3; ++edge) {
    if (!beyond(edge)) continue;
    const Nearest candidate = on_edge(triangle, edge, x);
    if (found.on_face || candidate.distance < found.distance) found = candidate;
  }
  return found;
}

Box bounds_of(const Plane&) {
  const Vec3 far = Vec3::Constant(std::numeric_limits<double>::infinity());
  return {-far, far};
}
Box bounds_of(const Segment& segment) {
  return Box(segment.from).extend(segment.from + segment.length * segment.along);
}
Box bounds_of(const Arc& arc) {
  Box box;
  for (const double end : {-arc.half_span, arc.half_span})
    box.extend(arc.centre + arc.radius * (Eigen::AngleAxisd(end, Vec3::UnitZ()) * arc.middle));
  for (const Vec3& out : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)})
    if (out.dot(arc.middle) >= std::cos(arc.half_span)) box.extend(arc.centre + arc.radius * out);
  return box;
}
Box bounds_of(const Triangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return Box(a).extend(b).extend(c);
}

Vec3 vertex(std::span<const double> vertices, std::size_t i) {
  return {vertices[2 * i], vertices[2 * i + 1], 0};
}

}  // namespace

Segment::Segment(const Vec3& a, const Vec3& b)
    : from(a), along((b - a).normalized()), normal(along.y(), -along.x(), 0), length((b - a).norm()) {}

Triangle::Triangle(const Corners& c) : corners(c), normal((c[1] - c[0]).cross(c[2] - c[0]).normalized()) {}

Nearest nearest(const Facet& facet, const Vec3& x) {
  return std::visit([&](const auto& shape) { return nearest_of(shape, x); }, facet);
}

std::string text(const Vec3& place) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", place.x(), place.y(), place.z());
}

Box bounds(const Facet& facet) {
  return std::visit([](const auto& shape) { return bounds_of(shape); }, facet);
}

std::vector<Facet> polyline(std::span<const double> vertices, bool closed) {
  std::vector<Facet> facets;
  const std::size_t n = vertices.size() / 2;
  for (std::size_t i = 0; i + 1 < n; ++i)
    facets.emplace_back(Segment(vertex(vertices, i), vertex(vertices, i + 1)));
  if (closed) facets.emplace_back(Segment(vertex(vertices, n - 1), vertex(vertices, 0)));
  return facets;
}

std::vector<Facet> arc(const Vec3& centre, double radius, double start, double end) {
  const double pieces = std::max(1.0, std::ceil(2 * (end - start) / std::numbers::pi - 1e-9));
  const double span = (end - start) / pieces;
  std::vector<Facet> facets;
  for (double i = 0; i < pieces; ++i)
    facets.emplace_back(Arc{centre, at_angle(start + (i + 0.5) * span), radius, 0.5 * span});
  return facets;
}

std::vector<Facet> mesh(std::span<const Corners> triangles, double scale) {
  constexpr double least = 1e-6;  // height over the longest edge; single precision knows no less
  std::vector<Facet> facets;
  for (const auto& [a, b, c] : triangles) {
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    if ((b - a).cross(c - a).norm() > least * longest)
      facets.emplace_back(Triangle({scale * a, scale * b, scale * c}));
  }
  return facets;
}

}  // namespace fpi::dem
