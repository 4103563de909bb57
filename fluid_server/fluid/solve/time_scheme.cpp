#include "fluid/solve/time_scheme.hpp"

#include <cmath>

namespace fpi::fluid {
namespace {

/// Of a velocity at the nodes that count.
double squared_norm(const Vector& u, const std::vector<std::uint8_t>& node_counts, double sum = 0) {
  for (std::size_t node = 0; node < node_counts.size(); ++node)
    if (node_counts[node]) sum += u.segment<2>(2 * static_cast<Eigen::Index>(node)).squaredNorm();
  return sum;
}

double norm(const Vector& u, const std::vector<std::uint8_t>& node_counts) {
  return std::sqrt(squared_norm(u, node_counts));
}

}  // namespace

Scheme Scheme::newmark(double time_step, double gamma) {
  return {1 / (gamma * time_step), 0, (1 - gamma) / gamma};
}

bool knows_past(double time_step, double previous_step) {
  constexpr double longest_growth = 1e3;  // more than any choice of steps makes of one
  return previous_step > 0 && time_step < longest_growth * previous_step;
}

Scheme Scheme::bdf2(double time_step, double previous_step) {
  if (!knows_past(time_step, previous_step)) return newmark(time_step, 1);
  const double omega = time_step / previous_step;
  return {(1 + 2 * omega) / ((1 + omega) * time_step), omega / (1 + omega) / previous_step, 0};
}

TimeTerms time_terms(const Scheme& scheme, const State& start, const Vector& displacement) {
  TimeTerms terms;
  terms.inertia = scheme.inertia;
  terms.history = scheme.inertia * start.u + scheme.acceleration * start.acceleration;
  if (scheme.is_bdf2()) terms.history += scheme.before * (start.u - start.previous_u);
  if (displacement.size() == 0) return terms;
  terms.mesh_velocity =
      scheme.inertia * displacement - scheme.before * start.previous_step * start.mesh_velocity;
  return terms;
}

Vector predicted_velocity(const State& state, double time_step, int order) {
  if (!state.has_acceleration || order == 0) return state.u;
  const Vector tangent = state.u + time_step * state.acceleration;
  if (!state.has_previous_acceleration || order == 1) return tangent;
  const double bend = 0.5 * time_step * time_step / state.previous_step;
  return tangent + bend * (state.acceleration - state.previous_acceleration);
}

int best_order(const State& state) {
  int best = highest_order;
  for (int order = highest_order - 1; order >= 0; --order)
    if (state.prediction_errors[order] < state.prediction_errors[best]) best = order;
  return best;
}

std::array<double, n_orders> prediction_errors(const State& start, const Vector& u, double time_step,
                                               const std::vector<std::uint8_t>& node_counts) {
  std::array<double, n_orders> errors = start.prediction_errors;
  for (int order = 0; order <= highest_order; ++order) {
    const Vector miss = u - predicted_velocity(start, time_step, order);
    errors[order] = 0.5 * squared_norm(miss, node_counts, errors[order]);
  }
  return errors;
}

namespace {

/// [tⁿ⁺¹, tⁿ, tⁿ⁻¹, tⁿ⁻²] u = u‴/6, the oldest velocity taken from the acceleration that it left in aⁿ.
Vector third_difference(const State& start, const Vector& u, double time_step) {
  const double before = start.previous_step;
  const Vector slope = (start.u - start.previous_u) / before;
  const Vector bend = ((u - start.u) / time_step - slope) / (time_step + before);
  const Vector bend_before = (start.acceleration - slope) / before;
  return (bend - bend_before) / (time_step + before + start.step_before);
}

}  // namespace

/// Newmark's method of second order is off by Δt³ u‴/12 and the prediction by (1/6 + 1/(4ω)) Δt³ u‴ to the
/// other side, BDF2 by (1 + ω)² Δt³ u‴/(6ω (1 + 2ω)).
TimeError time_error(const Scheme& scheme, const State& start, const Vector& u, double time_step,
                     const std::vector<std::uint8_t>& node_counts) {
  if (!start.has_acceleration || !start.has_previous_acceleration) return {};
  const double size = norm(u, node_counts);
  const double first_order = 0.5 * (1 - scheme.acceleration);  // (γ − ½)/γ, at γ = ½ 0 to the bit
  if (size == 0) return {0, 3};
  if (!scheme.is_bdf2() && first_order > 0)
    return {first_order * norm(u - start.u - time_step * start.acceleration, node_counts) / size, 2};
  const double omega = time_step / start.previous_step;
  if (scheme.is_bdf2()) {
    const double own = (1 + omega) * (1 + omega) / (omega * (1 + 2 * omega));
    return {own * std::pow(time_step, 3) * norm(third_difference(start, u, time_step), node_counts) / size,
            3};
  }
  const double own = 1.0 / 12, share = own / (own + 1.0 / 6 + 1 / (4 * omega));
  return {share * norm(u - predicted_velocity(start, time_step), node_counts) / size, 3};
}

}  // namespace fpi::fluid
