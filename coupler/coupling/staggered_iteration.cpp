#include "coupling/staggered_iteration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "coupling/aitken.hpp"
#include "coupling/constant_relaxation.hpp"
#include "coupling/make_acceleration.hpp"

namespace fpi::coupling {
namespace {

/// The iterate with the least residual so far: where an iteration that stalled goes on from.
struct Best {
  Eigen::VectorXd x, residual;
  void take(const Eigen::VectorXd& other, const Eigen::VectorXd& other_residual) {
    if (x.size() > 0 && other_residual.norm() >= residual.norm()) return;
    x = other;
    residual = other_residual;
  }
};

Eigen::Index largest(const Eigen::VectorXd& residual) {
  Eigen::Index at = 0;
  if (residual.size() > 0) residual.cwiseAbs().maxCoeff(&at);
  return at;
}

Residual operator*(double factor, const Residual& residual) {
  return {.relative = factor * residual.relative, .largest = factor * residual.largest};
}

}  // namespace

StaggeredIteration::StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs)
    : parameters_(parameters), lever_(dofs.lever()), acceleration_(make_acceleration(parameters)) {}

bool StaggeredIteration::is_good_enough(const ConvergenceMeasure& measure, double contraction,
                                        const StepResult& result) const {
  if (parameters_.scheme == "explicit") return true;
  if (parameters_.scheme == "semi_implicit" && result.sub_iterations == 2) return true;
  const bool is_safe = parameters_.scheme == "auto" && contraction <= safe_contraction;
  const double next = is_safe ? std::max(contraction, least_contraction) : 1;
  return measure.converged(next * result.velocity, next * result.force);
}

StepResult StaggeredIteration::solve(const CoupledMap& map, const Eigen::VectorXd& guess,
                                     const Eigen::VectorXd& inertia, double time_step, double contraction) {
  const ConvergenceMeasure measure(parameters_, inertia, lever_);
  const Eigen::VectorXd scale = inertia.cwiseSqrt();
  StepResult result;
  Eigen::VectorXd x = guess;
  StallWatch watch;
  Best best;
  ConstantRelaxation newton(1);
  std::optional<Aitken> fallback;
  acceleration_->begin_step();
  while (result.sub_iterations < parameters_.max_iterations) {
    const Exchange exchange = map(x, result.sub_iterations++);
    if (!exchange.converged) {
      result.reason = exchange.reason;
      return result;
    }
    if (!exchange.residual.allFinite() || !exchange.forces.allFinite()) {
      result.reason = "velocities or forces are no longer finite";
      return result;
    }
    Eigen::VectorXd scaled = x.cwiseProduct(scale), residual = exchange.residual.cwiseProduct(scale);
    result.velocity = measure.velocity(exchange.residual, exchange.velocities, exchange.fluid_speed);
    result.force = measure.force(exchange.residual, exchange.forces, time_step);
    result.worst = largest(residual);
    result.converged = is_good_enough(measure, contraction, result);
    if (result.converged) {
      acceleration_->finish(scaled, residual);
      return result;
    }
    best.take(scaled, residual);
    if (const Stall stall = watch.add(residual); stall != Stall::none) {
      // Two answers in turn from Newton's iteration: the map jumps between them, at an impact that the step
      // does or does not see, and only another step sees it otherwise.
      const bool jumps = exchange.is_newton && stall == Stall::cycle;
      const Remedy remedy = jumps ? Remedy::shorter_step : Remedy{static_cast<int>(result.stalls.size())};
      result.stalls.push_back({stall, remedy, result.worst});
      if (remedy == Remedy::shorter_step) break;
      if (remedy == Remedy::aitken) fallback.emplace(std::min(0.5, parameters_.relaxation));
      acceleration_->reject();
      acceleration_->begin_step();
      watch.reset();
      std::tie(scaled, residual) = std::tie(best.x, best.residual);
    }
    Acceleration& learnt = fallback ? *fallback : *acceleration_;
    Acceleration& acceleration = exchange.is_newton && !fallback ? newton : learnt;
    x = acceleration.next(scaled, residual).cwiseQuotient(scale);
    result.columns = acceleration_->columns();
  }
  result.reason = fmt::format(
      "the coupling did not converge in {} sub-iterations (residual of velocity {:.2g}, of force {:.2g}, "
      "relative)",
      result.sub_iterations, result.velocity.relative, result.force.relative);
  return result;
}

}  // namespace fpi::coupling
