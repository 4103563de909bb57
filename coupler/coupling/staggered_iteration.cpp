#include "coupling/staggered_iteration.hpp"

#include <fmt/format.h>

#include <utility>

namespace fpi::coupling {

StaggeredIteration::StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs)
    : max_iterations_(static_cast<std::uint32_t>(parameters.max_iterations)),
      scale_(dofs.inertia_root()),
      measure_(parameters, dofs),
      acceleration_(make_acceleration(parameters)) {}

StepResult StaggeredIteration::solve(const CoupledMap& map, const Eigen::VectorXd& guess, double time_step) {
  StepResult result;
  Eigen::VectorXd x = guess;
  acceleration_->begin_step();
  while (result.sub_iterations < max_iterations_) {
    const Exchange exchange = map(x, result.sub_iterations++);
    if (!exchange.converged) {
      result.reason = exchange.reason;
      return result;
    }
    if (!exchange.velocities.allFinite() || !exchange.forces.allFinite()) {
      result.reason = "velocities or forces are no longer finite";
      return result;
    }
    const Eigen::VectorXd residual = exchange.velocities - x;
    result.velocity = measure_.velocity(residual, exchange.velocities);
    result.force = measure_.force(residual, exchange.forces, time_step);
    result.converged = measure_.converged(result.velocity, result.force);
    if (result.converged) return result;
    x = acceleration_->next(x.cwiseProduct(scale_), residual.cwiseProduct(scale_)).cwiseQuotient(scale_);
  }
  result.reason = fmt::format(
      "the coupling did not converge in {} sub-iterations (residual of velocity {:.2g}, of force {:.2g}, "
      "relative)",
      max_iterations_, result.velocity.relative, result.force.relative);
  return result;
}

}  // namespace fpi::coupling
