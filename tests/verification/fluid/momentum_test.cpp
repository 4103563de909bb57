/// Fluid and bodies in a closed periodic cell keep the sum of their momenta, whatever starts or strikes
/// suddenly.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid::testing {
namespace {

constexpr double density = 1, radius = 0.15, time_step = 0.02;
const double area = std::numbers::pi * radius * radius;

/// A disc in a periodic cell of 1 m², with the fluid.
class Cell {
 public:
  explicit Cell(double density_ratio, const Vec2& flow = Vec2::Zero())
      : mass_(density_ratio * density * area), solver_(mesh(), with_flow(flow)) {
    motion.centre = {0.5, 0.5};
  }

  /// The balance of a free disc under a force [N/m], or its motion as it is given. It is placed where the
  /// velocities at both ends of the step bring it.
  BodyTraction step(double time, double dt, bool is_free, const Vec2& force = Vec2::Zero()) {
    const RigidVelocity start = motion;
    BodyTraction found = attempt(time, dt, start.translation, is_free, force);
    if (is_free) {
      solver_.restore();
      found = attempt(time, dt, found.motion.translation, is_free, force);
    }
    solver_.accept();
    motion = found.motion;
    return found;
  }
  /// Starts as the coupler lets it (Simulation::start_suddenly).
  BodyTraction start(bool is_free) { return step(0, 1e-6 * time_step, is_free); }

  double speed() const { return solver_.resolution().speed; }
  Vec2 momentum_of_fluid() const { return density * solver_.pore_flow().flux; }
  Vec2 momentum() const { return momentum_of_fluid() + mass_ * motion.translation; }

  RigidVelocity motion;

 private:
  BodyTraction attempt(double time, double dt, const Vec2& end, bool is_free, const Vec2& force) {
    Interface disc = circle(0, motion.centre + 0.5 * dt * (motion.translation + end), radius, 0.05);
    disc.rigid = {disc.rigid.centre, motion.translation, motion.spin};
    const double inertia = 0.5 * mass_ * radius * radius;
    if (is_free)
      disc.balance = {.mass_rate = mass_ / dt,
                      .inertia_rate = inertia / dt,
                      .load = mass_ / dt * motion.translation + force,
                      .torque = inertia / dt * motion.spin};
    const Result result = solver_.advance({time, dt, 0, {disc}});
    EXPECT_TRUE(result.newton.converged) << result.newton.reason;
    return result.tractions[0];
  }
  static Mesh mesh() {
    return make_rectangle(uniform_lines(0, 1, 24), uniform_lines(0, 1, 24), {}, {true, true});
  }
  static Settings with_flow(const Vec2& flow) {
    Settings s = settings(density, 0.02, {});
    s.bodies_move = true;
    s.fluid.initial_velocity = {fmt::format("{}", flow.x()), fmt::format("{}", flow.y())};
    return s;
  }

  double mass_;
  NavierStokes solver_;
};

class Momentum : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(DensityRatio, Momentum, ::testing::Values(3.0, 0.3));

TEST_P(Momentum, is_kept_from_the_initial_velocity_of_a_free_body_on) {
  Cell cell(GetParam());
  cell.motion.translation = {1, 0.2};
  cell.motion.spin = 5;
  const Vec2 given = GetParam() * density * area * cell.motion.translation;
  cell.start(true);
  EXPECT_LT((cell.momentum() - given).norm(), 1e-6 * given.norm());
  for (int k = 1; k <= 12; ++k) {
    cell.step(k * time_step, time_step, true);
    EXPECT_LT((cell.momentum() - given).norm(), 5e-5 * given.norm()) << "step " << k;
  }
}

TEST_P(Momentum, that_starts_suddenly_moves_no_element_of_the_fluid_many_times_faster_than_the_body) {
  Cell cell(GetParam());
  cell.motion.translation = {1, 0.2};
  cell.motion.spin = 5;
  cell.start(true);
  EXPECT_LT(cell.speed(), 10);
}

TEST_P(Momentum, is_kept_in_steps_much_shorter_than_those_in_which_the_first_vortices_form) {
  constexpr double short_step = time_step / 8;
  Cell cell(GetParam());
  cell.motion.translation = {1, 0.2};
  const Vec2 given = GetParam() * density * area * cell.motion.translation;
  cell.start(true);
  for (int k = 1; k <= 12; ++k) {
    cell.step(k * short_step, short_step, true);
    EXPECT_LT((cell.momentum() - given).norm(), 5e-5 * given.norm()) << "step " << k;
  }
}

TEST_P(Momentum, is_kept_by_a_body_at_rest_that_a_moving_fluid_takes_along) {
  Cell cell(GetParam(), Vec2(1, 0));
  const Vec2 given(density * (1 - area), 0);
  cell.start(true);
  EXPECT_LT((cell.momentum() - given).norm(), 1e-6 * given.norm());
  for (int k = 1; k <= 12; ++k) {
    cell.step(k * time_step, time_step, true);
    EXPECT_LT((cell.momentum() - given).norm(), 5e-5 * given.norm()) << "step " << k;
  }
}

TEST_P(Momentum, grows_by_the_impulse_that_strikes_a_body_within_a_step) {
  Cell cell(GetParam());
  const Vec2 impulse(0.05, 0.02);
  for (int k = 1; k <= 12; ++k) {
    cell.step(k * time_step, time_step, true, k == 3 ? Vec2(impulse / time_step) : Vec2::Zero());
    const Vec2 expected = k >= 3 ? impulse : Vec2::Zero();
    EXPECT_LT((cell.momentum() - expected).norm(), 2e-5 * impulse.norm()) << "step " << k;
  }
}

/// By the mean force over each step, with which a free body would be moved.
TEST(Momentum, of_the_fluid_is_what_a_body_that_is_set_going_at_once_gives_it) {
  Cell cell(1);
  cell.motion.translation = {1, 0};
  const RigidVelocity given = cell.motion;
  Vec2 sum = -1e-6 * time_step * cell.start(false).mean.force;
  EXPECT_LT((cell.momentum_of_fluid() - sum).norm(), 1e-6 * sum.norm());
  for (int k = 1; k <= 12; ++k) {
    cell.motion.translation = given.translation;
    const BodyTraction traction = cell.step(k * time_step, time_step, false);
    sum -= time_step * traction.mean.force;
    EXPECT_LT((cell.momentum_of_fluid() - sum).norm(), 5e-5 * sum.norm()) << "step " << k;
    EXPECT_LT(traction.mean.force.x(), 0) << "step " << k;  // a drag, from the first step on
  }
}

TEST(Superficial, velocity_given_is_that_of_fluid_and_free_body_together) {
  Settings s = settings(density, 0.05, {{"bottom", no_slip()}, {"top", no_slip()}});
  s.bodies_move = true;
  s.fluid.superficial_velocity = {"1", "0"};
  NavierStokes solver(make_rectangle(uniform_lines(0, 1, 16), uniform_lines(0, 1, 16), {}, {true, false}), s);
  Vec2 centre(0.93, 0.5), velocity(0, 0);  // across the periodic side
  for (int k = 1; k <= 4; ++k) {
    Interface disc = circle(0, centre, radius, 0.06);
    const double rate = density * area / 0.05;
    disc.rigid.translation = velocity;
    disc.balance = {.mass_rate = rate, .inertia_rate = 0.5 * rate * radius * radius, .load = rate * velocity};
    const Result result = solver.advance({0.05 * k, 0.05, 0, {disc}});
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    solver.accept();
    velocity = result.tractions[0].motion.translation;
    centre += 0.05 * velocity;
    EXPECT_NEAR(solver.superficial_velocity().x(), 1, 1e-6) << k;
    double mean = 0;
    for (const Section& slab : solver.sections(0, 8)) mean += slab.velocity / 8;
    EXPECT_NEAR(mean, 1, 2e-2) << k;  // a quadrature point counts in one slab
  }
  EXPECT_GT(velocity.x(), 0.5);
}

}  // namespace
}  // namespace fpi::fluid::testing
