/// The unknowns of the coupling: velocity and spin of every free body, three a disc (v_x, v_y, ω). They are
/// measured by inertia (√m, √I), so that a norm of velocities is a kinetic energy and one factor suits them
/// all.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "coupling/rigid_motion.hpp"

namespace fpi::coupling {

/// Force [N] and torque about the centre [N m] on a body.
struct RigidLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

class RigidDofs {
 public:
  /// `thickness` of the plane scene [m]. Throws Error for a free body that is not a disc or that has no mass.
  RigidDofs(std::span<const scene::Body> bodies, double thickness);

  Eigen::Index size() const { return inertia_root_.size(); }
  const std::vector<std::size_t>& bodies() const { return bodies_; }  ///< the free ones

  Eigen::VectorXd velocities(std::span<const RigidMotion> motions) const;
  Eigen::VectorXd loads(std::span<const RigidLoad> loads) const;
  void set_velocities(const Eigen::VectorXd& velocities, std::span<RigidMotion> motions) const;

  const Eigen::VectorXd& inertia_root() const { return inertia_root_; }  ///< √m [√kg], √I [√(kg m²)]
  const Eigen::VectorXd& lever() const { return lever_; }  ///< 1 of translations, R [m] of spins

 private:
  std::vector<std::size_t> bodies_;
  Eigen::VectorXd inertia_root_, lever_;
};

}  // namespace fpi::coupling
