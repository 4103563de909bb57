/// The shapes that walls are made of, and the point of each that is nearest to a place. Planes have grains on
/// one side, all others on both.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace fpi::dem {

using Vec3 = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

/// The point of a facet that is nearest to x.
struct Nearest {
  Vec3 place;       ///< [m]
  Vec3 normal;      ///< unit vector from there towards x
  double distance;  ///< [m], negative behind a plane
  bool on_face;     ///< false at an edge, a corner or an end
};

/// All x with normal·x < offset are behind it.
struct Plane {
  Vec3 normal;    ///< unit vector
  double offset;  ///< [m]
};

/// From one point to another in the plane z = const.
struct Segment {
  Segment(const Vec3& from, const Vec3& to);
  Vec3 from, along, normal;  ///< unit vectors
  double length;             ///< [m]
};

/// At most a quarter of a circle in the plane z = const: beyond its ends it has one nearest point.
struct Arc {
  Vec3 centre, middle;  ///< `middle`: unit vector from the centre to the middle of the arc
  double radius;        ///< [m]
  double half_span;     ///< [rad]
};

using Corners = std::array<Vec3, 3>;  ///< [m]

struct Triangle {
  explicit Triangle(const Corners& corners);
  Corners corners;
  Vec3 normal;  ///< unit vector
};

using Facet = std::variant<Plane, Segment, Arc, Triangle>;

Nearest nearest(const Facet& facet, const Vec3& x);
/// "(x, y, z)" for messages.
std::string text(const Vec3& place);
/// Smallest box around it; all of space around a plane.
Box bounds(const Facet& facet);
/// Whether it lies behind the plane through its nearest point: its distance to a place that moves is at least
/// what the way along the normal leaves.
inline bool is_convex(const Facet& facet) { return !std::holds_alternative<Arc>(facet); }

/// Segments from vertex to vertex (x, y of each); a closed one ends where it began.
std::vector<Facet> polyline(std::span<const double> vertices, bool closed);
/// The arc from angle `start` to `end` [rad], counter-clockwise, in pieces.
std::vector<Facet> arc(const Vec3& centre, double radius, double start, double end);
/// Triangles, `scale` times as large; those without an area, whose edges others have, are left out.
std::vector<Facet> mesh(std::span<const Corners> triangles, double scale);

}  // namespace fpi::dem
