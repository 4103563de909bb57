/// When a step has converged: the velocities that come back are those that went out, and the force that is
/// missing to make them so is small. Both are residuals of one sub-iteration, so that a good guess is
/// verified by a single one.
///
/// A velocity is small against those of the bodies or of the fluid, whichever are larger: what bodies feel
/// depends on how they move through the fluid, and where a flow passes bodies that rest, only the flow is
/// there to measure against.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "coupling/rigid_dofs.hpp"
#include "scene/coupling.hpp"

namespace fpi::coupling {

/// The size of one residual.
struct Residual {
  double relative = 0;  ///< in the norm of inertia, against the quantity's size; 0 where the residual is 0
  double largest = 0;   ///< the largest component [m/s] or [N]; spins count by R, torques by 1/R
};

class ConvergenceMeasure {
 public:
  /// `inertia` I > 0 of each unknown, what the fluid adds included; `lever`: 1 of translations, R [m] of
  /// spins.
  ConvergenceMeasure(const scene::Coupling& parameters, const Eigen::VectorXd& inertia,
                     const Eigen::VectorXd& lever)
      : parameters_(parameters), inertia_root_(inertia.cwiseSqrt()), lever_(lever) {
    for (Eigen::Index k = 0; k < inertia.size(); k += 3) mass_root_ += inertia[k];
    mass_root_ = std::sqrt(mass_root_);
  }

  /// Of the difference r of the velocities that fluid and DEM have, against these or, where that is more,
  /// against all bodies moving at the speed of the fluid (root mean square [m/s]).
  Residual velocity(const Eigen::VectorXd& residual, const Eigen::VectorXd& velocities,
                    double fluid_speed = 0) const;
  /// Of I r/Δt, the force that is missing to make them one within the step, against the force of the fluid.
  Residual force(const Eigen::VectorXd& residual, const Eigen::VectorXd& forces, double time_step) const;

  /// Both pass, each by its relative or by its absolute measure.
  bool converged(const Residual& velocity, const Residual& force) const;

 private:
  scene::Coupling parameters_;
  Eigen::VectorXd inertia_root_, lever_;
  double mass_root_ = 0;  ///< of the inertia of all translations along one axis
};

}  // namespace fpi::coupling
