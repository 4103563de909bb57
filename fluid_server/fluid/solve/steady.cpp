#include "fluid/solve/steady.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/log.hpp"

namespace fpi::fluid {

NewtonResult solve_steady(System& system, const Flow& flow, const scene::Newton& parameters, Iterate& iterate,
                          Profiler& monitor) {
  constexpr double smallest_part = 1.0 / 128, on_the_way = 1e-3;  // the latter of the velocity
  const TimeTerms time = TimeTerms::steady(static_cast<Index>(iterate.fields.u.size() / 2));
  Flow now = flow;
  now.convection = 0;
  NewtonResult result = solve(system, now, time, parameters, iterate, monitor);
  double part = 1;  // of the Reynolds number, from one flow to the next
  while (result.converged && now.convection < flow.convection) {
    const double reached = now.convection;
    const Fields fields = iterate.fields;
    now.convection = std::min(reached + part, flow.convection);
    scene::Newton loose = parameters;
    loose.relative_tolerance = std::max(on_the_way, parameters.relative_tolerance);
    const bool is_last = now.convection == flow.convection;
    const NewtonResult next = solve(system, now, time, is_last ? parameters : loose, iterate, monitor);
    result.iterations += next.iterations;
    result.update = next.update;
    if (next.converged) {
      part *= 2;
      continue;
    }
    log::info(
        "the steady flow at {:.3g} of the Reynolds number was not found ({}): going on from {:.3g} in "
        "smaller parts",
        now.convection, next.reason, reached);
    monitor.timers.counts["continuation_retreats"] += 1;
    now.convection = reached;
    iterate.fields = fields;
    iterate.corrector = {};
    part /= 4;
    if (part >= smallest_part) continue;
    result.converged = false;
    result.reason = fmt::format(
        "no steady flow was found beyond {:.3g} of the Reynolds number, also by continuation: {}. Take a "
        "finer "
        "mesh there, or solve in time: there may be no steady flow",
        reached, next.reason);
  }
  return result;
}

}  // namespace fpi::fluid
