/// When a step has converged: the velocities that come back are those that went out, and the force that is
/// missing to make them so is small. Both are residuals of one exchange, so that a good guess is verified by
/// a single one.
#pragma once

#include <Eigen/Core>

#include "coupling/rigid_dofs.hpp"
#include "scene/coupling.hpp"

namespace fpi::coupling {

/// The size of one residual.
struct Residual {
  double relative = 0;  ///< in the norm of inertia, against the quantity itself; 0 where the residual is 0
  double largest = 0;   ///< the largest component [m/s] or [N]; spins count by R, torques by 1/R
};

class ConvergenceMeasure {
 public:
  /// `inertia` I > 0 of each unknown, what the fluid adds included; `lever`: 1 of translations, R [m] of
  /// spins.
  ConvergenceMeasure(const scene::Coupling& parameters, const Eigen::VectorXd& inertia,
                     const Eigen::VectorXd& lever)
      : parameters_(parameters), inertia_root_(inertia.cwiseSqrt()), lever_(lever) {}

  /// Of the difference r of the velocities that fluid and DEM have, against these.
  Residual velocity(const Eigen::VectorXd& residual, const Eigen::VectorXd& velocities) const;
  /// Of I r/Δt, the force that is missing to make them one within the step, against the force of the fluid.
  Residual force(const Eigen::VectorXd& residual, const Eigen::VectorXd& forces, double time_step) const;

  /// Both pass, each by its relative or by its absolute measure.
  bool converged(const Residual& velocity, const Residual& force) const;

 private:
  scene::Coupling parameters_;
  Eigen::VectorXd inertia_root_, lever_;
};

}  // namespace fpi::coupling
