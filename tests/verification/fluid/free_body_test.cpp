/// Bodies that the fluid moves itself: their balance of momentum holds, and the velocity found exerts, as a
/// given one, the same force; at any mass, none included.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid::testing {
namespace {

constexpr double density = 1, radius = 0.125, time_step = 0.01, gravity = 9.81;
const double buoyancy = density * gravity * std::numbers::pi * radius * radius;  // [N/m]

Settings closed_box() {
  auto s = settings(density, 0.1,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.gravity = {0, -gravity};
  s.fluid.newton.relative_tolerance = 1e-10;
  s.bodies_move = true;
  return s;
}

/// A disc of so many times the fluid's density, under its weight and moving with `rigid`.
Interface falling(Index body, const Vec2& centre, double density_ratio, const RigidVelocity& rigid) {
  Interface disc = circle(body, centre, radius, 0.05);
  disc.rigid = {centre, rigid.translation, rigid.spin};
  const double mass = density_ratio * density * disc.surface.area();
  const double inertia = 0.5 * mass * radius * radius;
  disc.balance = {.mass_rate = mass / time_step,
                  .inertia_rate = inertia / time_step,
                  .load = mass / time_step * rigid.translation + Vec2(0, -gravity * mass),
                  .torque = inertia / time_step * rigid.spin};
  return disc;
}

class FreeBody : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(DensityRatio, FreeBody, ::testing::Values(2.5, 1.0, 0.1, 0.0));

/// Two discs of which one shears the other, for a few steps: what their momentum gains is what acts on them.
TEST_P(FreeBody, balances_hold_and_the_velocities_found_exert_the_same_forces_when_given) {
  NavierStokes solver(square(20), closed_box()), given(square(20), closed_box());
  std::vector<Vec2> centre{{0.3, 0.62}, {0.53, 0.41}};
  std::vector<RigidVelocity> motion(2);
  for (int step = 1; step <= 3; ++step) {
    Request request{step * time_step, time_step, 0, {}}, again = request;
    for (Index i = 0; i < 2; ++i)
      request.interfaces.push_back(falling(i, centre[i], GetParam() * (i + 1), motion[i]));
    const Result result = solver.advance(request);
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    for (Index i = 0; i < 2; ++i) {
      const BodyTraction& traction = result.tractions[i];
      const Balance& balance = *request.interfaces[i].balance;
      const Vec2 gained = balance.mass_rate * traction.motion.translation - balance.load;
      EXPECT_LT((gained - traction.mean.force).norm(), 1e-9 * buoyancy);
      EXPECT_NEAR(balance.inertia_rate * traction.motion.spin - balance.torque, traction.mean.torque,
                  1e-9 * radius * buoyancy);
      again.interfaces.push_back(request.interfaces[i]);
      again.interfaces.back().balance.reset();
    }
    ASSERT_TRUE(given.advance(again).newton.converged);
    again.sub_iteration = 1;
    for (Index i = 0; i < 2; ++i) again.interfaces[i].rigid = result.tractions[i].motion;
    const Result same = given.advance(again);
    ASSERT_TRUE(same.newton.converged) << same.newton.reason;
    for (Index i = 0; i < 2; ++i) {
      EXPECT_LT((same.tractions[i].force - result.tractions[i].force).norm(), 1e-6 * buoyancy);
      EXPECT_NEAR(same.tractions[i].torque, result.tractions[i].torque, 1e-6 * radius * buoyancy);
      centre[i] += time_step * (0.5 * motion[i].translation + 0.5 * result.tractions[i].motion.translation);
      motion[i] = result.tractions[i].motion;
    }
    solver.accept();
    given.accept();
  }
  EXPECT_GT(motion[0].translation.norm(), 1e-3);
  EXPECT_GT(std::abs(motion[0].spin), 1e-4);
}

/// In Stokes flow the answer to forces is linear: what changes with them is what the resistance says.
TEST(FreeBody, resistance_tells_what_forces_on_all_bodies_change) {
  auto settings = closed_box();
  settings.fluid.convection = false;
  if (!gives_schur_complements(settings.fluid.linear_solver)) GTEST_SKIP() << "no linear solver gives it";
  NavierStokes solver(square(20), settings);
  Request request{time_step, time_step, 0, {}, true};
  request.interfaces = {falling(0, {0.3, 0.62}, 0.5, {}), circle(1, {0.8, 0.8}, 0.1, 0.05),
                        falling(2, {0.53, 0.51}, 2, {})};
  const Result before = solver.advance(request);
  ASSERT_TRUE(before.newton.converged) << before.newton.reason;
  ASSERT_EQ(before.resistance.rows(), 6);
  const Vector push = Vector::LinSpaced(6, -0.02, 0.03);
  request.sub_iteration = 1;
  request.wants_resistance = false;
  for (const Index i : {0, 2}) {
    Balance& balance = *request.interfaces[i].balance;
    const Index at = 3 * (i / 2);
    balance.load += push.segment<2>(at);
    balance.torque += push[at + 2];
  }
  const Result after = solver.advance(request);
  ASSERT_TRUE(after.newton.converged) << after.newton.reason;
  EXPECT_EQ(after.resistance.size(), 0);
  Vector change(6);
  for (const Index i : {0, 2}) {
    const RigidVelocity &was = before.tractions[i].motion, &is = after.tractions[i].motion;
    change.segment<3>(3 * (i / 2)) << is.translation - was.translation, is.spin - was.spin;
  }
  EXPECT_GT(change.norm(), 1e-4);
  EXPECT_LT((before.resistance * change - push).norm(), 1e-8 * push.norm());
}

/// Bodies that rest, to the bit, leave the matrix as it was.
TEST(FreeBody, resistance_and_factor_are_kept_while_no_body_is_moved) {
  auto settings = closed_box();
  settings.fluid.convection = false;
  settings.fluid.newmark_gamma = 1;  // the same inertia in every step
  if (!gives_schur_complements(settings.fluid.linear_solver)) GTEST_SKIP() << "no linear solver gives it";
  NavierStokes solver(square(20), settings);
  Request request{time_step, time_step, 0, {}, true};
  request.interfaces = {falling(0, {0.3, 0.62}, 0.5, {}), falling(1, {0.53, 0.41}, 2, {})};
  std::vector<Result> results;
  for (int step = 0; step < 3; ++step, request.time += time_step) {
    results.push_back(solver.advance(request));
    ASSERT_TRUE(results.back().newton.converged) << results.back().newton.reason;
    solver.accept();
  }
  EXPECT_EQ(solver.monitor.timers.counts["factorisations"], 1);
  ASSERT_EQ(results[2].resistance.rows(), 6);
  EXPECT_EQ(results[2].resistance, results[0].resistance);
}

/// Without inertia and torque a disc turns at half the shear rate in Stokes flow (Jeffery 1922); far walls
/// that keep the undisturbed shear change that by (R/L)⁴.
TEST(FreeBody, a_disc_in_stokes_shear_turns_at_half_the_shear_rate) {
  const scene::Boundary shear = velocity("y", "0");
  auto s = settings(1, 1, {{"left", shear}, {"right", shear}, {"bottom", shear}, {"top", shear}});
  s.fluid.convection = false;
  s.fluid.newmark_gamma = 1;
  s.bodies_move = true;
  NavierStokes solver(square(24, -0.5, 0.5), s);
  Interface disc = circle(0, {0.003, 0}, 0.08, 0.03);
  disc.balance = Balance{};
  Result result;
  for (int step = 1; step <= 3; ++step) {
    result = solver.advance({step * 10., 10, 0, {disc}});
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    solver.accept();
  }
  EXPECT_NEAR(result.tractions[0].motion.spin, -0.5, 1e-3);
}

TEST(FreeBody, a_steady_flow_is_not_asked_to_move_bodies) {
  NavierStokes solver(square(8), closed_box());
  EXPECT_THROW(solver.advance({0, 0, 0, {falling(0, {0.5, 0.5}, 2, {})}}), Error);
}

}  // namespace
}  // namespace fpi::fluid::testing
