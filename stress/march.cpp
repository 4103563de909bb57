#include "march.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace fpi::fluid::testing {

namespace {

/// Why the accepted step is no sensible one; "" where it is.
std::string out_of_bounds(const NavierStokes& solver, const Result& result, const Bounds& bounds) {
  const double velocity = solver.velocity_with_bodies().lpNorm<Eigen::Infinity>();
  if (!(velocity <= bounds.velocity))
    return fmt::format("the velocity reaches {:.3g} m/s; up to {:.3g} were expected", velocity,
                       bounds.velocity);
  for (const BodyTraction& t : result.tractions)
    if (!(t.force.norm() <= bounds.force) || !std::isfinite(t.torque))
      return fmt::format("the force on body {} is {:.3g} N/m; up to {:.3g} was expected", t.body,
                         t.force.norm(), bounds.force);
  return "";
}

/// One step, whose loads and corrections go to the history; why it failed, or "".
std::string take_step(NavierStokes& solver, const Request& request, const Bounds& bounds, History& history) {
  const Result result = solver.advance(request);
  if (!result.newton.converged) return result.newton.reason;
  solver.accept();
  history.corrections += result.newton.iterations;
  history.loads.emplace_back();
  for (const BodyTraction& t : result.tractions) history.loads.back().push_back({t.force, t.torque});
  return out_of_bounds(solver, result, bounds);
}

}  // namespace

History march(NavierStokes& solver, const Bodies& bodies, double time_step, int steps, const Bounds& bounds) {
  History history;
  for (int step = 1; step <= steps && history.failure.empty(); ++step) {
    std::string problem;
    try {
      const double t = step * time_step;
      problem = take_step(solver, {t, time_step, 0, bodies(t, solver)}, bounds, history);
    } catch (const Error& e) {
      problem = e.what();
      history.refused = true;
    }
    if (!problem.empty()) history.failure = fmt::format("step {} of {}: {}", step, steps, problem);
  }
  history.corrections /= std::max<double>(1, static_cast<double>(history.loads.size()));
  return history;
}

std::vector<Vec2> forces(const History& history, std::size_t body) {
  std::vector<Vec2> out;
  for (const auto& loads : history.loads) out.push_back(loads[body].force);
  return out;
}

Noise noise(const std::vector<Vec2>& force, std::size_t first) {
  Noise out;
  for (std::size_t k = first; k < force.size(); ++k)
    out.largest_force = std::max(out.largest_force, force[k].norm());
  double square_sum = 0;
  std::size_t count = 0;
  for (std::size_t k = std::max<std::size_t>(first, 2); k + 2 < force.size(); ++k, ++count) {
    const Vec2 cubic = (4 * (force[k - 1] + force[k + 1]) - force[k - 2] - force[k + 2]) / 6;
    const double distance = (force[k] - cubic).norm() / out.largest_force;
    out.worst = std::max(out.worst, distance);
    square_sum += distance * distance;
  }
  out.rms = count == 0 ? 0 : std::sqrt(square_sum / static_cast<double>(count));
  return out;
}

}  // namespace fpi::fluid::testing
