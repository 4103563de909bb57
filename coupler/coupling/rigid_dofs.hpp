/// The unknowns of the coupling: velocity and spin of every free body, three a disc (v_x, v_y, ω).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "coupling/rigid_motion.hpp"

namespace fpi::coupling {

/// Force [N] and torque about the centre [N m] on a body: at the end of a step or, where the body is free, in
/// the mean over it, which is what its momentum gains.
struct RigidLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

class RigidDofs {
 public:
  /// `thickness` of the plane scene [m]. Throws Error for a free body that is not a disc.
  RigidDofs(std::span<const scene::Body> bodies, double thickness);

  Eigen::Index size() const { return inertia_.size(); }
  double thickness() const { return thickness_; }                     ///< [m]
  const std::vector<std::size_t>& bodies() const { return bodies_; }  ///< the free ones

  Eigen::VectorXd velocities(std::span<const RigidMotion> motions) const;
  Eigen::VectorXd loads(std::span<const RigidLoad> loads) const;
  void set_loads(const Eigen::VectorXd& forces, std::span<RigidLoad> loads) const;
  void set_velocities(const Eigen::VectorXd& velocities, std::span<RigidMotion> motions) const;

  const Eigen::VectorXd& inertia() const { return inertia_; }  ///< m [kg], I [kg m²]; 0 of massless bodies
  const Eigen::VectorXd& lever() const { return lever_; }      ///< 1 of translations, R [m] of spins

 private:
  std::vector<std::size_t> bodies_;
  double thickness_;
  Eigen::VectorXd inertia_, lever_;
};

}  // namespace fpi::coupling
