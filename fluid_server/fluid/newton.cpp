#include "fluid/newton.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

/// Velocities below this are round-off of the pressure: p · min(h/μ, Δt/(ρh)) · 1e-13, times the root of the
/// number.
double round_off_velocity(const Flow& flow, const TimeTerms& time, const Fields& fields, double h) {
  const double viscous = h / flow.viscosity;
  const double inertia = time.inertia.maxCoeff();
  const double mobility = inertia > 0 ? std::min(viscous, 1 / (inertia * flow.density * h)) : viscous;
  return 1e-13 * mobility * fields.p.lpNorm<Eigen::Infinity>() *
         std::sqrt(static_cast<double>(fields.u.size()));
}

}  // namespace

NewtonResult solve(System& system, const Flow& flow, const TimeTerms& time, const scene::Newton& parameters,
                   Iterate& iterate, Monitor& monitor) {
  NewtonResult result;
  auto& ledger = monitor.ledger;
  double previous = 0;
  while (result.iterations < parameters.max_iterations) {
    ++result.iterations;
    ledger.counts["newton_iterations"] += 1;
    const bool refactor = !iterate.factor;
    Vector residual;
    {
      monitor.phase("assembly");
      const ScopedTimer timer(ledger, "assembly");
      residual = system.gather(system.assemble(flow, iterate.fields, time, refactor));
    }
    if (refactor) {
      monitor.phase("factor");
      const ScopedTimer timer(ledger, "factor");
      ledger.counts["factorisations"] += 1;
      iterate.factor = system.analysis()->factor(system.matrix());
      if (iterate.factor->is_singular()) {
        iterate.factor.reset();
        result.reason =
            "the matrix is singular (arcs far shorter than the elements, or bodies on top of each other?)";
        return result;
      }
    }
    Vector update;
    {
      monitor.phase("solve");
      const ScopedTimer timer(ledger, "solve");
      ledger.counts["solves"] += 1;
      update = iterate.factor->solve(residual);
    }
    const Vector before = iterate.fields.u;
    system.add(update, -1, iterate.fields);
    const double change = (iterate.fields.u - before).norm();
    const double size = iterate.fields.u.norm();
    if (!std::isfinite(change) || !std::isfinite(size) || !iterate.fields.p.allFinite() ||
        !iterate.fields.lambda.allFinite()) {
      iterate.factor.reset();
      result.reason = "the solution is not finite";
      return result;
    }
    result.update = size > 0 ? change / size : 0;
    if (!flow.convection || change <= parameters.relative_tolerance * size ||
        change <= round_off_velocity(flow, time, iterate.fields, system.smallest_size())) {
      result.converged = true;
      return result;
    }
    if (result.iterations > 1 && change > parameters.refactor_ratio * previous) iterate.factor.reset();
    previous = change;
  }
  result.reason = fmt::format(
      "Newton's iteration did not reach {:g} in {} iterations; the last update was {:.3g} of "
      "the velocity",
      parameters.relative_tolerance, parameters.max_iterations, result.update);
  return result;
}

}  // namespace fpi::fluid
