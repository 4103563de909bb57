#include "coupling/convergence.hpp"

#include <algorithm>

namespace fpi::coupling {
namespace {

double ratio(double residual, double size) { return residual > 0 ? residual / size : 0; }

}  // namespace

Residual ConvergenceMeasure::velocity(const Eigen::VectorXd& residual, const Eigen::VectorXd& velocities,
                                      double fluid_speed) const {
  const double size = std::max(velocities.cwiseProduct(inertia_root_).norm(), mass_root_ * fluid_speed);
  return {.relative = ratio(residual.cwiseProduct(inertia_root_).norm(), size),
          .largest = residual.cwiseProduct(lever_).lpNorm<Eigen::Infinity>()};
}

Residual ConvergenceMeasure::force(const Eigen::VectorXd& residual, const Eigen::VectorXd& forces,
                                   double time_step) const {
  const Eigen::VectorXd scaled = residual.cwiseProduct(inertia_root_) / time_step;
  return {.relative = ratio(scaled.norm(), forces.cwiseQuotient(inertia_root_).norm()),
          .largest = scaled.cwiseProduct(inertia_root_).cwiseQuotient(lever_).lpNorm<Eigen::Infinity>()};
}

bool ConvergenceMeasure::converged(const Residual& velocity, const Residual& force) const {
  const double tolerance = parameters_.relative_tolerance;
  return (velocity.relative <= tolerance || velocity.largest <= parameters_.absolute_velocity) &&
         (force.relative <= tolerance || force.largest <= parameters_.absolute_force);
}

}  // namespace fpi::coupling
