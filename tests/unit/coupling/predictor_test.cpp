/// First guesses of velocities, and which of them is taken.
#include "coupling/predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fpi::coupling {
namespace {

/// One body of mass 2 with an added mass of 1, and no force.
StepStart start_with(const Eigen::VectorXd& velocities, double time_step) {
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(velocities.size());
  return {.velocities = velocities,
          .force = 0 * ones,
          .inertia = 2 * ones,
          .added_inertia = ones,
          .time_step = time_step};
}

/// Feeds velocity(t) over steps of changing size; the guess for the last one, and what it should be.
template <class Velocity>
std::pair<Eigen::VectorXd, Eigen::VectorXd> guess_of(Predictor& predictor, Velocity velocity, int steps = 6) {
  double t = 0;
  for (int k = 0;; ++k) {
    const double dt = 0.1 + 0.03 * (k % 3);
    const Eigen::VectorXd guess = predictor.guess(start_with(velocity(t), dt));
    t += dt;
    if (k == steps) return {guess, velocity(t)};
    predictor.accept(velocity(t));
  }
}

Eigen::Vector3d straight(double t) { return {1 + 3 * t, 2 - 5 * t, t}; }
Eigen::Vector3d curved(double t) { return {1 + 3 * t * t, 2 - 5 * t + t * t, -t * t}; }

TEST(Predictor, without_history_is_constant_but_for_the_force) {
  for (const char* kind : {"constant", "linear", "quadratic"})
    EXPECT_EQ(Predictor(kind).guess(start_with(Eigen::Vector3d(1, 2, 3), 0.1)), Eigen::Vector3d(1, 2, 3));
  StepStart start = start_with(Eigen::Vector3d(1, 2, 3), 0.1);
  start.force = Eigen::Vector3d(0, -6, 0);
  EXPECT_TRUE(Predictor("physical").guess(start).isApprox(Eigen::Vector3d(1, 1.8, 3), 1e-14));
  EXPECT_TRUE(Predictor("auto").guess(start).isApprox(Eigen::Vector3d(1, 1.8, 3), 1e-14));
}

TEST(Predictor, extrapolates_to_its_order_at_any_step_sizes) {
  Predictor linear("linear"), quadratic("quadratic");
  const auto [guess, found] = guess_of(linear, straight);
  EXPECT_TRUE(guess.isApprox(found, 1e-13));
  const auto [curved_guess, curved_found] = guess_of(quadratic, curved);
  EXPECT_TRUE(curved_guess.isApprox(curved_found, 1e-13));
}

TEST(Predictor, by_the_equation_of_motion_is_linear_in_free_flight_and_knows_nothing_of_an_impact) {
  // m a = F throughout: the acceleration goes on. Then an impact turns the velocity round.
  Predictor predictor("physical");
  StepStart start = start_with(Eigen::Vector3d(0, 1, 0), 0.1);
  start.force = Eigen::Vector3d(0, -2, 0);  // m = 2: a = -1
  predictor.guess(start);
  predictor.accept(Eigen::Vector3d(0, 0.9, 0));
  start.velocities = Eigen::Vector3d(0, 0.9, 0);
  EXPECT_TRUE(predictor.guess(start).isApprox(Eigen::Vector3d(0, 0.8, 0), 1e-14));
  const double after = 5, a = (after - 0.9) / 0.1;
  predictor.accept(Eigen::Vector3d(0, after, 0));
  start.velocities = Eigen::Vector3d(0, after, 0);
  start.force =
      Eigen::Vector3d(0, -2 - 1 * a, 0);  // the fluid has answered to the impact with its added mass
  EXPECT_NEAR(predictor.guess(start)[1], after - 0.1 * 2 / 3, 1e-13);
}

TEST(Predictor, takes_for_each_body_the_kind_that_was_best) {
  Predictor predictor("auto");
  const auto two = [](double t) {
    Eigen::VectorXd v(6);
    v << curved(t), 1, -2, 0.5;  // the second does not accelerate, but for kicks that come back
    v[3] += std::fmod(std::round(100 * t), 2) == 0 ? 0.1 : -0.1;
    return v;
  };
  const auto [guess, found] = guess_of(predictor, two, 12);
  EXPECT_TRUE(guess.head(3).isApprox(found.head(3), 1e-12)) << "quadratic";
  EXPECT_LT((guess - found).tail(3).norm(), 0.21) << "constant: an extrapolated kick misses by 0.4";
}

TEST(Predictor, falls_back_to_the_last_velocity_after_a_rejected_step) {
  Predictor predictor("linear");
  guess_of(predictor, straight);
  const StepStart start = start_with(Eigen::Vector3d(7, 8, 9), 0.1);
  EXPECT_NE(predictor.guess(start), start.velocities);
  predictor.reject();
  EXPECT_EQ(predictor.guess(start), start.velocities);
  predictor.accept(Eigen::Vector3d(8, 8, 9));
  const StepStart next = start_with(Eigen::Vector3d(8, 8, 9), 0.1);
  EXPECT_NE(predictor.guess(next), next.velocities);
}

TEST(Predictor, state_comes_back_to_the_bit) {
  for (const char* kind : {"linear", "quadratic", "physical", "auto"}) {
    Predictor predictor(kind), other(kind);
    guess_of(predictor, curved);
    predictor.accept(Eigen::Vector3d(0.1, 1. / 3, 7));
    other.set_state(predictor.state());
    const StepStart start = start_with(Eigen::Vector3d(1, 2, 3), 0.3);
    EXPECT_EQ(predictor.guess(start), other.guess(start));
    EXPECT_EQ(predictor.state(), other.state());
  }
}

}  // namespace
}  // namespace fpi::coupling
