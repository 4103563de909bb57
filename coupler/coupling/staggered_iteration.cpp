#include "coupling/staggered_iteration.hpp"

#include <fmt/format.h>

#include <utility>

namespace fpi::coupling {

StaggeredIteration::StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs)
    : parameters_(parameters), lever_(dofs.lever()), acceleration_(make_acceleration(parameters)) {}

StepResult StaggeredIteration::solve(const CoupledMap& map, const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& inertia, double time_step) {
  const ConvergenceMeasure measure(parameters_, inertia, lever_);
  const Eigen::VectorXd scale = inertia.cwiseSqrt();
  StepResult result;
  Eigen::VectorXd x = guess;
  acceleration_->begin_step();
  while (result.sub_iterations < parameters_.max_iterations) {
    const Exchange exchange = map(x, result.sub_iterations++);
    if (!exchange.converged) {
      result.reason = exchange.reason;
      return result;
    }
    const Eigen::VectorXd& residual = exchange.residual;
    if (!residual.allFinite() || !exchange.forces.allFinite()) {
      result.reason = "velocities or forces are no longer finite";
      return result;
    }
    result.velocity = measure.velocity(residual, exchange.velocities);
    result.force = measure.force(residual, exchange.forces, time_step);
    result.converged = measure.converged(result.velocity, result.force);
    const Eigen::VectorXd scaled = x.cwiseProduct(scale), scaled_residual = residual.cwiseProduct(scale);
    if (result.converged) {
      acceleration_->finish(scaled, scaled_residual);
      return result;
    }
    x = acceleration_->next(scaled, scaled_residual).cwiseQuotient(scale);
  }
  result.reason = fmt::format(
      "the coupling did not converge in {} sub-iterations (residual of velocity {:.2g}, of force {:.2g}, "
      "relative)",
      parameters_.max_iterations, result.velocity.relative, result.force.relative);
  return result;
}

}  // namespace fpi::coupling
