/// The interface mesh: a body's circle cut into equal arcs, or each side of its polygon into equal edges, of
/// about the length that the fluid wants, and the rigid velocity field on them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "coupling/rigid_motion.hpp"

namespace fpi::coupling {

/// Arcs of one circle; arc a runs counter-clockwise from angle start[a] to end[a] [rad], and end[a] is
/// start[a + 1] to the bit. Or edges of one polygon; edge a runs from vertex a to a + 1, counter-clockwise.
struct Arcs {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< that torque is about [m]
  double radius = 0;                                 ///< [m]; 0: edges
  std::vector<double> start, end;
  std::vector<double> vertices;  ///< x, y of each [m]
  std::size_t size() const { return radius > 0 ? start.size() : vertices.size() / 2; }
  /// The point a fraction s along arc or edge a, from the centre [m].
  Eigen::Vector2d from_centre(std::size_t a, double s) const;
};

/// The circle in N ≥ 3 equal arcs, N = 2πR/length rounded. Throws Error unless radius and length are
/// positive.
Arcs cut_circle(const Eigen::Vector3d& centre, double radius, double wanted_length);

/// The polygon through `corners` (x, y of each, counter-clockwise, seen from the centre [m]) turned by
/// `orientation`, each side in N ≥ 1 equal edges, N = side/length rounded. Throws Error unless the length is
/// positive.
Arcs cut_polygon(const Eigen::Vector3d& centre, const Eigen::Quaterniond& orientation,
                 const std::vector<double>& corners, double wanted_length);

/// What the fluid sees of a body at its place: a circle of the hydraulic radius, or the polygon.
Arcs cut_surface(const scene::Body& body, const RigidMotion& motion, double hydraulic_radius_ratio,
                 double wanted_length);

/// Gauss–Legendre points an arc at which velocities are given: exact for velocities of degree 5 in the angle.
inline constexpr std::size_t points_per_arc = 3;

/// u = V + ω × (x − c) [m/s] at the points of every arc: x, y of each, arc after arc.
std::vector<double> velocities_on(const Arcs& arcs, const RigidMotion& motion);

}  // namespace fpi::coupling
