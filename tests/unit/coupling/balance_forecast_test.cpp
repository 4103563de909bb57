/// The balance of bodies with the fluid, foretold from that of the last steps.
#include "coupling/balance_forecast.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

namespace fpi::coupling {
namespace {

/// Two unknowns, each dragged along by the other, in a flow that exerts `drive` on both: backward Euler in the first
/// step, then the bodies by backward Euler and the fluid by BDF2.
class Bodies {
 public:
  Eigen::Vector2d mass{2, 3}, displaced{1, 1.5};
  Eigen::Matrix2d drag{{4, -1.5}, {-1, 5}};

  Eigen::MatrixXd resistance(double dt) const {
    const double r = step_ > 0 ? dt / step_ : 0;
    return drag + Eigen::MatrixXd(((mass + (1 + 2 * r) / (1 + r) * displaced) / dt).asDiagonal());
  }
  Eigen::VectorXd velocities(double dt, const Eigen::VectorXd& forces, const Eigen::VectorXd& drive) const {
    const double r = step_ > 0 ? dt / step_ : 0;
    const Eigen::VectorXd history = mass.cwiseProduct(now) +
                                    displaced.cwiseProduct((1 + r) * now - r * r / (1 + r) * before_);
    return resistance(dt).partialPivLu().solve(history / dt + drive + forces);
  }
  void step(double dt, const Eigen::VectorXd& forces, const Eigen::VectorXd& drive, BalanceForecast& forecast) {
    const Eigen::VectorXd next = velocities(dt, forces, drive);
    forecast.accept(dt, now, next, forces, resistance(dt));
    before_ = now;
    now = next;
    step_ = dt;
  }
  BalanceForecast forecast() const { return {mass, displaced}; }

  Eigen::VectorXd now = Eigen::Vector2d(0.3, -0.2);

 private:
  Eigen::VectorXd before_ = Eigen::Vector2d::Zero();
  double step_ = 0;
};

Eigen::Vector2d impact(int k) { return {10 * std::sin(7.0 * k), -20 * std::cos(5.0 * k)}; }

TEST(BalanceForecast, in_a_steady_flow_any_forces_move_bodies_as_foretold) {
  Bodies bodies;
  BalanceForecast forecast = bodies.forecast();
  EXPECT_FALSE(forecast.knows());
  const Eigen::Vector2d drive(1, -2);
  for (int k = 0; k < 6; ++k) {
    bodies.step(0.1, impact(k), drive, forecast);
    if (k == 0) continue;  // the next step is the first by BDF2
    const Eigen::VectorXd next = bodies.velocities(0.1, impact(k + 1), drive);
    EXPECT_LT((forecast.velocities(0.1, impact(k + 1)) - next).norm(), 1e-13) << k;
  }
}

TEST(BalanceForecast, half_of_what_the_drive_gained_is_expected_again) {
  Bodies bodies;
  BalanceForecast forecast = bodies.forecast();
  const Eigen::Vector2d rise(0.4, 0.6);
  for (int k = 1; k < 6; ++k) bodies.step(0.1, impact(k), k * rise, forecast);
  const Eigen::VectorXd expected = bodies.velocities(0.1, impact(6), 5.5 * rise);
  EXPECT_LT((forecast.velocities(0.1, impact(6)) - expected).norm(), 1e-13);
}

TEST(BalanceForecast, a_shorter_step_resists_more_by_the_momentum_alone) {
  Bodies bodies;
  bodies.displaced.setZero();
  BalanceForecast forecast = bodies.forecast();
  const Eigen::Vector2d drive(1, -2);
  for (int k = 0; k < 3; ++k) bodies.step(0.1, impact(k), drive, forecast);
  EXPECT_LT((forecast.resistance(0.05) - bodies.resistance(0.05)).norm(), 1e-12);
  EXPECT_LT((forecast.velocities(0.05, impact(3)) - bodies.velocities(0.05, impact(3), drive)).norm(), 1e-13);
}

TEST(BalanceForecast, what_left_rests_and_pushes_no_other) {
  Bodies bodies;
  BalanceForecast forecast = bodies.forecast();
  for (int k = 0; k < 3; ++k) bodies.step(0.1, impact(k), Eigen::Vector2d(1, -2), forecast);
  forecast.take_out(std::vector<Eigen::Index>{0});
  const Eigen::VectorXd some = forecast.velocities(0.1, Eigen::Vector2d(0, 1));
  const Eigen::VectorXd others = forecast.velocities(0.1, Eigen::Vector2d(1e9, 1));
  EXPECT_EQ(some[0], 0);
  EXPECT_EQ(some, others);
}

TEST(BalanceForecast, goes_on_bitwise_from_its_state) {
  Bodies bodies;
  BalanceForecast forecast = bodies.forecast(), resumed = bodies.forecast();
  resumed.set_state(forecast.state());
  EXPECT_FALSE(resumed.knows());
  for (int k = 0; k < 3; ++k) bodies.step(0.1, impact(k), k * Eigen::Vector2d(1, -2), forecast);
  resumed.set_state(forecast.state());
  EXPECT_EQ(resumed.velocities(0.07, impact(3)), forecast.velocities(0.07, impact(3)));
  forecast.forget();
  EXPECT_FALSE(forecast.knows());
}

}  // namespace
}  // namespace fpi::coupling
