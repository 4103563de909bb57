/// The interface mesh: a body's circle cut into equal arcs of about the length that the fluid wants, and the
/// rigid velocity field on them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "coupling/rigid_motion.hpp"

namespace fpi::coupling {

/// Arcs of one circle; arc a runs counter-clockwise from angle start[a] to end[a] [rad], and end[a] is
/// start[a + 1] to the bit.
struct Arcs {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0;                                 ///< [m]
  std::vector<double> start, end;
  std::size_t size() const { return start.size(); }
};

/// The circle in N ≥ 3 equal arcs, N = 2πR/length rounded. Throws Error unless radius and length are
/// positive.
Arcs cut_circle(const Eigen::Vector3d& centre, double radius, double wanted_length);

/// Gauss–Legendre points an arc at which velocities are given: exact for velocities of degree 5 in the angle.
inline constexpr std::size_t points_per_arc = 3;

/// u = V + ω × (x − c) [m/s] at the points of every arc: x, y of each, arc after arc.
std::vector<double> velocities_on(const Arcs& arcs, const RigidMotion& motion);

}  // namespace fpi::coupling
