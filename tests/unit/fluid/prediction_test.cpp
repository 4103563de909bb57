/// The velocity that a step starts from: extrapolated by the order that came nearest in the last steps.
#include <gtest/gtest.h>

#include "fluid/solve/time_scheme.hpp"

namespace fpi::fluid {
namespace {

constexpr double dt = 0.1;

/// Two nodes whose velocity is f(t), up to t.
State history(double (*f)(double), double t) {
  State state = State::at_rest(2, 1);
  const auto at = [&](double time) { return Vector(Vector::Constant(4, f(time))); };
  const auto rate = [&](double time) { return Vector((at(time + 1e-6) - at(time - 1e-6)) / 2e-6); };
  state.u = at(t);
  state.acceleration = rate(t);
  state.previous_acceleration = rate(t - dt);
  state.has_acceleration = state.has_previous_acceleration = true;
  state.previous_step = dt;
  return state;
}

/// Of which order the guess is after some steps.
int chosen(double (*f)(double)) {
  std::array<double, n_orders> errors{};
  for (int n = 0; n < 10; ++n) {
    State state = history(f, n * dt);
    state.prediction_errors = errors;
    errors = prediction_errors(state, Vector::Constant(4, f((n + 1) * dt)), dt, {1, 1});
  }
  State state = history(f, 10 * dt);
  state.prediction_errors = errors;
  return best_order(state);
}

TEST(Prediction, takes_the_highest_order_in_a_smooth_flow_and_the_lowest_where_bodies_strike_it) {
  EXPECT_EQ(chosen([](double t) { return std::sin(2 * t); }), 2);
  EXPECT_EQ(chosen([](double t) { return std::sin(1e3 * t); }), 0);
}

TEST(Prediction, takes_the_highest_order_before_anything_is_known) {
  EXPECT_EQ(best_order(State::at_rest(1, 1)), 2);
}

TEST(Prediction, does_not_learn_from_nodes_in_bodies) {
  const State state = history([](double t) { return t * t; }, 1);
  Vector u = state.u;
  u.tail<2>().setConstant(1e9);
  const auto errors = prediction_errors(state, u, dt, {1, 0});
  EXPECT_EQ(errors[0], 0);
  EXPECT_LT(errors[2], 1);
}

}  // namespace
}  // namespace fpi::fluid
