/// When a step has converged: the velocities that come back are those that went out, and the forces no longer
/// change.
#pragma once

#include <Eigen/Core>

#include "coupling/rigid_dofs.hpp"
#include "scene/coupling.hpp"

namespace fpi::coupling {

/// One quantity's change in a sub-iteration.
struct Change {
  double relative = 0;  ///< in the norm of inertia, against the quantity's size; 0 where both vanish
  double largest = 0;   ///< the largest component [m/s] or [N]; spins count by R, torques by 1/R
};

class ConvergenceMeasure {
 public:
  ConvergenceMeasure(const scene::Coupling& parameters, const RigidDofs& dofs)
      : parameters_(parameters), inertia_root_(dofs.inertia_root()), lever_(dofs.lever()) {}

  Change velocity_change(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;
  Change force_change(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;

  /// Both quantities pass, each by its relative or by its absolute measure.
  bool converged(const Change& velocity, const Change& force) const;

 private:
  scene::Coupling parameters_;
  Eigen::VectorXd inertia_root_, lever_;
};

}  // namespace fpi::coupling
