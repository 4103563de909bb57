#include "coupling/convergence.hpp"

namespace fpi::coupling {
namespace {

double ratio(double change, double size) { return change > 0 ? change / size : 0; }

}  // namespace

Change ConvergenceMeasure::velocity_change(const Eigen::VectorXd& before,
                                           const Eigen::VectorXd& after) const {
  const Eigen::VectorXd change = after - before;
  return {
      .relative = ratio(change.cwiseProduct(inertia_root_).norm(), after.cwiseProduct(inertia_root_).norm()),
      .largest = change.cwiseProduct(lever_).lpNorm<Eigen::Infinity>()};
}

Change ConvergenceMeasure::force_change(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const {
  const Eigen::VectorXd change = after - before;
  return {.relative =
              ratio(change.cwiseQuotient(inertia_root_).norm(), after.cwiseQuotient(inertia_root_).norm()),
          .largest = change.cwiseQuotient(lever_).lpNorm<Eigen::Infinity>()};
}

bool ConvergenceMeasure::converged(const Change& velocity, const Change& force) const {
  const double tolerance = parameters_.relative_tolerance;
  return (velocity.relative <= tolerance || velocity.largest <= parameters_.absolute_velocity) &&
         (force.relative <= tolerance || force.largest <= parameters_.absolute_force);
}

}  // namespace fpi::coupling
