/// The balance of bodies with the fluid, foretold from that of the last steps.
#include "coupling/predicted_force.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

namespace fpi::coupling {
namespace {

/// Two unknowns, each dragged along by the other, in a flow that exerts `drive` on both: backward Euler in
/// the first step, then BDF2, for the bodies as for the fluid.
class Bodies {
 public:
  Eigen::Vector2d mass{2, 3}, displaced{1, 1.5};
  Eigen::Matrix2d drag{{4, -1.5}, {-1, 5}};

  double gamma(double dt) const {
    const double r = step_ > 0 ? dt / step_ : 0;
    return (1 + r) / (1 + 2 * r);
  }
  Eigen::MatrixXd resistance(double dt) const {
    return gamma(dt) * drag + Eigen::MatrixXd(((mass + displaced) / dt).asDiagonal());
  }
  Eigen::VectorXd velocities(double dt, const Eigen::VectorXd& forces, const Eigen::VectorXd& drive) const {
    const Eigen::VectorXd history = (mass + displaced).cwiseProduct(now) / dt + (1 - gamma(dt)) * mean_;
    return resistance(dt).partialPivLu().solve(history + gamma(dt) * drive + forces);
  }
  void step(double dt, const Eigen::VectorXd& forces, const Eigen::VectorXd& drive,
            PredictedForce& forecast) {
    const Eigen::VectorXd next = velocities(dt, forces, drive);
    forecast.accept(dt, now, next, forces, resistance(dt));
    mean_ = gamma(dt) * (drive - drag * next) + (1 - gamma(dt)) * mean_;
    now = next;
    step_ = dt;
  }
  PredictedForce forecast() const { return {mass, displaced}; }

  Eigen::VectorXd now = Eigen::Vector2d(0.3, -0.2);

 private:
  Eigen::VectorXd mean_ = Eigen::Vector2d::Zero();
  double step_ = 0;
};

Eigen::Vector2d impact(int k) { return {10 * std::sin(7.0 * k), -20 * std::cos(5.0 * k)}; }

TEST(PredictedForce, in_a_steady_flow_any_forces_move_bodies_as_foretold) {
  Bodies bodies;
  PredictedForce forecast = bodies.forecast();
  EXPECT_FALSE(forecast.knows());
  const Eigen::Vector2d drive(1, -2);
  for (int k = 0; k < 6; ++k) {
    bodies.step(0.1, impact(k), drive, forecast);
    const Eigen::VectorXd next = bodies.velocities(0.1, impact(k + 1), drive);
    EXPECT_LT((forecast.velocities(0.1, impact(k + 1)) - next).norm(), 1e-13) << k;
  }
}

TEST(PredictedForce, half_of_what_the_drive_gained_is_expected_again) {
  Bodies bodies;
  PredictedForce forecast = bodies.forecast();
  const Eigen::Vector2d rise(0.4, 0.6);
  for (int k = 1; k < 6; ++k) bodies.step(0.1, impact(k), k * rise, forecast);
  const Eigen::VectorXd expected = bodies.velocities(0.1, impact(6), 5.5 * rise);
  EXPECT_LT((forecast.velocities(0.1, impact(6)) - expected).norm(), 1e-13);
}

TEST(PredictedForce, a_shorter_step_resists_as_its_momentum_and_its_scheme_say) {
  Bodies bodies;
  PredictedForce forecast = bodies.forecast();
  const Eigen::Vector2d drive(1, -2);
  for (int k = 0; k < 3; ++k) bodies.step(0.1, impact(k), drive, forecast);
  EXPECT_LT((forecast.resistance(0.05) - bodies.resistance(0.05)).norm(), 1e-12);
  EXPECT_LT((forecast.velocities(0.05, impact(3)) - bodies.velocities(0.05, impact(3), drive)).norm(), 1e-13);
}

TEST(PredictedForce, what_left_rests_and_pushes_no_other) {
  Bodies bodies;
  PredictedForce forecast = bodies.forecast();
  for (int k = 0; k < 3; ++k) bodies.step(0.1, impact(k), Eigen::Vector2d(1, -2), forecast);
  forecast.take_out(std::vector<Eigen::Index>{0});
  const Eigen::VectorXd some = forecast.velocities(0.1, Eigen::Vector2d(0, 1));
  const Eigen::VectorXd others = forecast.velocities(0.1, Eigen::Vector2d(1e9, 1));
  EXPECT_EQ(some[0], 0);
  EXPECT_EQ(some, others);
}

TEST(PredictedForce, goes_on_bitwise_from_its_state) {
  Bodies bodies;
  PredictedForce forecast = bodies.forecast(), resumed = bodies.forecast();
  resumed.set_state(forecast.state());
  EXPECT_FALSE(resumed.knows());
  for (int k = 0; k < 3; ++k) bodies.step(0.1, impact(k), k * Eigen::Vector2d(1, -2), forecast);
  resumed.set_state(forecast.state());
  EXPECT_EQ(resumed.velocities(0.07, impact(3)), forecast.velocities(0.07, impact(3)));
}

TEST(PredictedForce, a_step_without_resistance_leaves_nothing_to_foretell_but_its_momentum) {
  Bodies bodies;
  PredictedForce forecast = bodies.forecast();
  const Eigen::Vector2d drive(1, -2);
  bodies.step(0.1, impact(0), drive, forecast);
  const Eigen::VectorXd before = bodies.now, next = bodies.velocities(0.1, impact(1), drive);
  forecast.accept(0.1, before, next, impact(1), {});
  EXPECT_FALSE(forecast.knows());
  PredictedForce ignored = bodies.forecast();
  bodies.step(0.1, impact(1), drive, ignored);
  bodies.step(0.1, impact(2), drive, forecast);
  const Eigen::VectorXd expected = bodies.velocities(0.1, impact(3), drive);
  EXPECT_LT((forecast.velocities(0.1, impact(3)) - expected).norm(), 1e-13);
}

}  // namespace
}  // namespace fpi::coupling
