/// One step in time: Newmark's method (paper, eqs. 10–11), or BDF2 where bodies move, since γ = ½ never damps
/// what their cuts do to the stored acceleration. BDF2 is Newmark's method with γ = (1 + ω)/(1 + 2ω), ω the
/// ratio of the step to the one before, and with the mean acceleration over the last step for the one at its
/// end.
#pragma once

#include "fluid/base/state.hpp"
#include "fluid/discretisation/system.hpp"

namespace fpi::fluid {

/// Whether the last step tells how the flow changes: there was one, and not so short a one that all it did
/// was to take up a sudden start (its velocities are to start from then, its accelerations mean nothing).
bool knows_past(double time_step, double previous_step);

/// a^{n+1} = inertia · u^{n+1} − [inertia · u^n + before · (u^n − u^{n−1}) + acceleration · a^n].
struct Scheme {
  double inertia = 0;       ///< 1/(γ Δt) [1/s]
  double before = 0;        ///< [1/s]
  double acceleration = 0;  ///< (1 − γ)/γ

  static Scheme newmark(double time_step, double gamma);
  /// Backward Euler where `knows_past` is false.
  static Scheme bdf2(double time_step, double previous_step);
  bool is_bdf2() const { return before > 0; }
  /// γ of a step of Δt [s]: a force on a body has the mean γ F^{n+1} + (1 − γ) × its mean over the last step,
  /// so that what the fluid loses in a step the body gains to round-off, whatever either did before.
  double gamma(double time_step) const { return 1 / (inertia * time_step); }
};

/// Where the nodes went by `displacement` [m] in the step, `start` holds what they took along; empty: they
/// stay.
TimeTerms time_terms(const Scheme& scheme, const State& start, const Vector& displacement = {});

/// The velocity after the next step without solving for it: u, of order 0, u + Δt a, of order 1, or
/// u + Δt a + ½ Δt²/Δt_previous (a − a_previous), Adams and Bashforth's second order; as much of it as the
/// state's history allows.
Vector predicted_velocity(const State& state, double time_step, int order = highest_order);

/// The order that came nearest in the last steps: a smooth flow is best foreseen by the highest one, while
/// one that bodies strike changes in ways that no acceleration foretells.
int best_order(const State& state);
/// The errors that it chooses by, with those of the step from `start` to u at the nodes that count: squares,
/// halved in weight with each step.
std::array<double, n_orders> prediction_errors(const State& start, const Vector& u, double time_step,
                                               const std::vector<std::uint8_t>& node_counts);

/// Error of a step in time, relative to the velocity, at the nodes that count: by Newmark's method from its
/// distance to the prediction (P. M. Gresho, R. L. Lee, R. L. Sani, On the time-dependent solution of the
/// incompressible Navier–Stokes equations, 1980), by BDF2 from the third divided difference of the last four
/// velocities, which holds whatever the steps between them are.
struct TimeError {
  double relative = 0;  ///< 0: the history is too short to tell
  int power = 0;        ///< of Δt that the error of a step goes with
};
TimeError time_error(const Scheme& scheme, const State& start, const Vector& u, double time_step,
                     const std::vector<std::uint8_t>& node_counts);

}  // namespace fpi::fluid
