/// Forces of a fluid over a step: held, or linear from the end of the step before.
#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::bitwise_equal;
using test::body;
using test::step;

Problem pushed(const std::string& loads) {
  Problem problem;
  problem.thickness = 0.5;
  problem.bodies = {body("b", "disc", 0.1, 1000, {0, 0})};
  problem.dem.loads = loads;
  return problem;
}

/// Force cos(3t) and torque 0.01 sin(5t), at the end of each of `n` steps to t = 1: how far place, velocity
/// and spin are from the truth.
double error(Problem problem, int n) {
  Solver solver(problem);
  for (int i = 1; i <= n; ++i) {
    const double t = double(i) / n;
    const Load load{.body = 0, .force = {std::cos(3 * t), 0, 0}, .torque = {0, 0, 0.01 * std::sin(5 * t)}};
    step(solver, 1.0 / n, {&load, 1});
  }
  const double mass = solver.model().bodies.mass[0], inertia = solver.model().bodies.inertia[0];
  const Motions& m = solver.motions();
  return std::abs(mass * m.position[0].x() - (1 - std::cos(3.0)) / 9) +
         std::abs(mass * m.velocity[0].x() - std::sin(3.0) / 3) +
         std::abs(inertia * m.spin[0].z() - 0.01 * (1 - std::cos(5.0)) / 5);
}

TEST(Loads, linear_ones_are_of_second_order_in_the_step_and_held_ones_of_first) {
  const auto order = [](const std::string& loads) {
    return std::log2(error(pushed(loads), 800) / error(pushed(loads), 1600));
  };
  EXPECT_NEAR(order("held"), 1, 0.02);
  EXPECT_NEAR(order("linear"), 2, 0.02);
  EXPECT_LT(error(pushed("linear"), 100), 0.02 * error(pushed("held"), 100));
}

/// A force 2t from t = 0.1 on; until then it is held at 0.
Solver under_growing_force(double largest_sub_step) {
  Problem problem = pushed("linear");
  problem.dem.largest_sub_step = largest_sub_step;
  Solver solver(problem);
  for (const double end : {0.1, 0.4, 1.0}) {
    const Load load{.body = 0, .force = {0, end > 0.1 ? 2 * end : 0.2, 0}};
    step(solver, end == 0.1 ? 0.1 : end == 0.4 ? 0.3 : 0.6, {&load, 1});
  }
  return solver;
}

TEST(Loads, linear_ones_move_a_free_body_exactly_in_one_flight_and_in_many_sub_steps) {
  for (const double sub_step : {0.0, 0.01}) {
    const Solver solver = under_growing_force(sub_step);
    const double mass = solver.model().bodies.mass[0];
    // 0.2 N until 0.1 s, then 2t N: with T = 0.9 s to go, v = 0.02 + 0.2 T + T², x = 0.001 + 0.02 T + 0.1 T²
    // + T³/3.
    EXPECT_NEAR(mass * solver.motions().velocity[0].y(), 0.02 + 0.18 + 0.81, 1e-13) << sub_step;
    EXPECT_NEAR(mass * solver.motions().position[0].y(), 0.001 + 0.018 + 0.081 + 0.243, 1e-13) << sub_step;
  }
}

TEST(Loads, linear_ones_are_rolled_back_and_resumed_bitwise) {
  Problem problem = test::box_of_discs();
  problem.dem.loads = "linear";
  Solver solver(problem);
  const auto load = [](double force) { return Load{.body = 7, .force = {force, 0, 0}}; };
  const auto advance = [&](Solver& which, double force) {
    const Load of = load(force);
    ASSERT_TRUE(which.advance(5e-3, {&of, 1}).converged);
  };
  advance(solver, 0.5);
  solver.accept();
  const std::vector<std::uint8_t> bytes = solver.checkpoint();
  advance(solver, 3);  // a trial
  advance(solver, 1);
  const Motions first = solver.motions();
  solver.restore();
  advance(solver, 1);
  EXPECT_TRUE(bitwise_equal(solver.motions(), first));
  Solver resumed(problem);
  resumed.resume(bytes);
  EXPECT_EQ(resumed.checkpoint(), bytes);
  advance(resumed, 1);
  EXPECT_TRUE(bitwise_equal(resumed.motions(), first));
  Solver held(test::box_of_discs());
  advance(held, 0.5);
  held.accept();
  advance(held, 1);
  EXPECT_FALSE(bitwise_equal(held.motions(), first));
}

/// A force that grows throws a ball against a wall within one step.
TEST(Loads, growing_ones_do_not_hide_a_contact_from_a_flight) {
  Problem problem;
  problem.dem.loads = "linear";
  problem.materials = {test::material(1e10, 0.3)};
  problem.walls = {test::wall("wall", {0.05, 0, 0}, {-1, 0, 0})};
  problem.bodies = {body("ball", "sphere", 0.01, 2500, {0, 0, 0}, {0, 0, 0})};
  Solver solver(problem);
  Load load{.body = 0};
  step(solver, 0.01, {&load, 1});
  load.force = {30, 0, 0};
  const Advanced outcome = step(solver, 0.05, {&load, 1});
  EXPECT_GT(outcome.sub_steps, 20u);
  EXPECT_GT(outcome.largest_overlap, 0);
  EXPECT_LT(outcome.largest_overlap, 1e-3 * 0.5);
  EXPECT_LT(solver.motions().position[0].x(), 0.0405);
}

}  // namespace
}  // namespace fpi::dem
