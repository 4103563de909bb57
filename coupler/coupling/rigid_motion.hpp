/// The rigid state of a body, as the coupling sees it. Plane scenes have z = 0 and spin about z.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "scene/bodies.hpp"

namespace fpi::coupling {

struct RigidMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< centre [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< [rad/s]
};

inline Eigen::Vector3d to_eigen(const scene::Vec3& v) { return {v[0], v[1], v[2]}; }

/// Where the scene puts a body at t = 0.
RigidMotion initial_motion(const scene::Body& body);

/// The position after a step of size Δt with the mean of the velocities at its ends (trapezoidal rule).
inline Eigen::Vector3d trapezoidal_position(const RigidMotion& before, const Eigen::Vector3d& velocity_after,
                                            double time_step) {
  return before.position + 0.5 * time_step * (before.velocity + velocity_after);
}

}  // namespace fpi::coupling
