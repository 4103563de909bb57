#include "coupling/staggered_iteration.hpp"

#include <fmt/format.h>

#include <utility>

namespace fpi::coupling {

StaggeredIteration::StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs)
    : max_iterations_(static_cast<std::uint32_t>(parameters.max_iterations)),
      scale_(dofs.inertia_root()),
      measure_(parameters, dofs),
      acceleration_(make_acceleration(parameters)) {}

StepResult StaggeredIteration::solve(const CoupledMap& map, const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& forces_before) {
  StepResult result;
  Eigen::VectorXd x = guess, forces = forces_before;
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
    result.velocity = measure_.velocity_change(x, exchange.velocities);
    result.force = measure_.force_change(forces, exchange.forces);
    result.converged = measure_.converged(result.velocity, result.force);
    if (result.converged) return result;
    const Eigen::VectorXd residual = exchange.velocities - x;
    x = acceleration_->next(x.cwiseProduct(scale_), residual.cwiseProduct(scale_)).cwiseQuotient(scale_);
    forces = exchange.forces;
  }
  result.reason = fmt::format(
      "the coupling did not converge in {} sub-iterations (change of velocity {:.2g}, of force "
      "{:.2g}, relative)",
      max_iterations_, result.velocity.relative, result.force.relative);
  return result;
}

}  // namespace fpi::coupling
