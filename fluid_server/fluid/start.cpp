/// How a run with γ < 1 starts: with a consistent acceleration, after a few damped steps where the flow
/// begins suddenly or from rest.
#include "core/log.hpp"
#include "fluid/navier_stokes.hpp"

namespace fpi::fluid {

/// γ < 1 starts from an acceleration. A velocity that meets the boundaries and is divergence-free has one. A
/// start that is sudden, or from rest, where walls have boundary layers thinner than an element at first,
/// takes steps of two backward Euler halves before, since what is stiff would ring for ever at γ = ½ (R.
/// Rannacher, Numer. Math. 43, 1984). They have the matrix of a whole step at γ = ½.
NewtonResult NavierStokes::begin(const Request& request) {
  constexpr int damped_steps = 2;
  constexpr double sudden = 0.1;  // part of the velocity that boundaries change at once, or that was there
  if (start_.damped_steps > 0) return first_half_step(request);
  State consistent = start_;
  const NewtonResult result = find_consistent_start(request, consistent);
  if (!result.converged) return result;
  const double speed = consistent.u.norm(), gain = request.time_step * consistent.acceleration.norm();
  Vector at_end =
      consistent.u;  // as far as boundaries give it: an inflow that rises smoothly leaves gain behind
  space_.boundary.impose(request.time, at_end);
  const bool from_rest = speed < sudden * gain && at_end.norm() < gain / sudden;
  const bool is_sudden = from_rest || (consistent.u - start_.u).norm() > sudden * speed;
  if (start_.damped_steps < 0 && is_sudden) {
    log::info("the flow starts from rest or suddenly at t = {} s: {} damped steps come first", start_.time,
              damped_steps);
    start_.damped_steps = damped_steps;
    return first_half_step(request);
  }
  start_ = std::move(consistent);
  start_.damped_steps = 0;
  return result;
}

NewtonResult NavierStokes::first_half_step(const Request& request) {
  const double half = 0.5 * request.time_step;
  const TimeTerms terms = time_terms(Scheme::newmark(half, 1), start_);
  Iterate& iterate =
      base_ = {with_multipliers(start_.u, start_.p), kept_.lend(terms.inertia, system_ == accepted_system_)};
  system_->set_load(request.time - half, body_force_);
  space_.boundary.impose(request.time - half, iterate.fields.u);
  const NewtonResult result = solve(*system_, flow_, terms, settings_.fluid.newton, iterate, monitor);
  start_.u = iterate.fields.u;
  start_.p = iterate.fields.p;
  return result;
}

/// Two backward Euler steps of vanishing length: the first makes the velocity divergence-free and has it meet
/// the boundaries, the second finds the acceleration that the equations and the boundaries then ask for.
NewtonResult NavierStokes::find_consistent_start(const Request& request, State& start) {
  const double tiny = 1e-6 * request.time_step;
  Iterate iterate{with_multipliers(start.u, start.p), {}};
  NewtonResult result;
  for (const double t : {start.time, start.time + tiny}) {
    start.u = iterate.fields.u;
    const TimeTerms terms = time_terms(Scheme::newmark(tiny, 1), start);
    system_->set_load(t, body_force_);
    space_.boundary.impose(t, iterate.fields.u);
    result = solve(*system_, flow_, terms, settings_.fluid.newton, iterate, monitor);
    if (!result.converged) {
      result.reason = "no consistent initial acceleration was found: " + result.reason;
      return result;
    }
    if (t > start.time) start.acceleration = terms.acceleration(iterate.fields.u);
  }
  start.p = iterate.fields.p;
  start.has_acceleration = true;
  return result;
}

}  // namespace fpi::fluid
