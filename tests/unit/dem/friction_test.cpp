#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::on_floor;
using test::step;

constexpr double g = 9.81;

/// A body that rests on the floor at the overlap that carries its weight, all damping done.
Problem resting(const std::string& shape, double friction, double rolling_friction = 0) {
  const scene::Material m = material(1e8, 0.3, 0.5, friction, rolling_friction);
  Problem problem = on_floor(m, body("b", shape, 0.01, 2500, {0, 0.01, 0}, {0, 0, 0}));
  problem.thickness = 0.01;
  const double weight = g * 2500 * problem.bodies[0].volume(0.01, problem.thickness);
  const double stiffness = 4.0 / 3 * combine(m, m).normal * 0.1;
  problem.bodies[0].position[1] -= std::pow(weight / stiffness, 2.0 / 3);
  return problem;
}

TEST(Friction, sliding_turns_into_rolling_at_the_speed_and_time_of_theory) {
  for (const auto& [shape, share, over] :
       {std::tuple{"sphere", 5.0 / 7, 7.0 / 2}, std::tuple{"disc", 2.0 / 3, 3.0}}) {
    Problem problem = resting(shape, 0.3);
    problem.bodies[0].velocity = {0.5, 0, 0};
    Solver solver(problem);
    const double rolls_from = 0.5 / (over * 0.3 * g);
    step(solver, 0.9 * rolls_from);
    EXPECT_NEAR(solver.motions().velocity[0].x(), 0.5 - 0.3 * g * 0.9 * rolls_from, 1e-4) << shape;
    step(solver, 0.2 * rolls_from);
    for (int i = 0; i < 10; ++i) step(solver, 0.02);
    EXPECT_NEAR(solver.motions().velocity[0].x(), 0.5 * share, 1e-6) << shape;
    EXPECT_NEAR(solver.motions().spin[0].z(), -0.5 * share / 0.01, 1e-4) << shape;
  }
}

TEST(Friction, an_incline_makes_a_sphere_roll_or_slip_by_its_slope) {
  for (const double slope : {3.4 * 0.2, 3.6 * 0.2}) {
    Problem problem = resting("sphere", 0.2);
    const double angle = std::atan(slope);
    problem.gravity = {g * std::sin(angle), -g * std::cos(angle), 0};
    Solver solver(problem);
    const auto slip = [&] { return solver.motions().velocity[0].x() + 0.01 * solver.motions().spin[0].z(); };
    for (int i = 0; i < 10; ++i) step(solver, 0.01);
    const double before = slip();
    for (int i = 0; i < 10; ++i) step(solver, 0.01);
    const double theory = slope < 0.7 ? 0 : g * (std::sin(angle) - 3.5 * 0.2 * std::cos(angle));
    EXPECT_NEAR((slip() - before) / 0.1, theory, 1e-4);
  }
}

TEST(Friction, a_push_below_the_limit_stretches_the_spring_by_force_over_stiffness) {
  Problem problem = resting("sphere", 0.5);
  Solver solver(problem);
  const double weight = solver.model().bodies.mass[0] * g;
  // Force through the contact's height: friction takes it, and the torque keeps the sphere from turning.
  const double force = 0.4 * 0.5 * weight;
  const Load load{.body = 0, .force = {force, 0, 0}, .torque = {0, 0, 0.01 * force}};
  for (int i = 0; i < 200; ++i) step(solver, 1e-3, std::span(&load, 1));
  const PairLaw& law = solver.model().laws(0, 0);
  const double overlap = 0.01 - solver.motions().position[0].y();
  const double stiffness = 2 * law.tangential_ratio * law.normal * std::sqrt(0.01 * overlap);
  const double surface = solver.motions().position[0].x() +
                         0.01 * 2 * solver.motions().orientation[0].base.z();  // small rotation about z
  EXPECT_NEAR(surface * stiffness / force, 1, 1e-4);
  EXPECT_LT(solver.motions().velocity[0].norm(), 1e-6);
}

TEST(Friction, rolling_friction_stops_a_rolling_disc) {
  Problem problem = resting("disc", 0.5, 0.1);
  problem.bodies[0].velocity = {0.1, 0};
  problem.bodies[0].spin = {-10};
  Solver solver(problem);
  // Deceleration μ_r g/(1 + 1/2): it rolls for v 1.5/(μ_r g).
  const double stops = 0.1 * 1.5 / (0.1 * g);
  step(solver, 0.5 * stops);
  EXPECT_NEAR(solver.motions().velocity[0].x(), 0.05, 1e-3);
  for (int i = 0; i < 5; ++i) step(solver, 0.5 * stops);
  EXPECT_NEAR(solver.motions().velocity[0].x(), 0, 1e-5);
  EXPECT_NEAR(solver.motions().spin[0].z(), 0, 1e-3);
}

TEST(Friction, twisting_friction_stops_a_top) {
  Problem problem = resting("sphere", 0.5);
  problem.materials[0].twisting_friction = 0.02;
  problem.bodies[0].spin = {0, 50, 0};
  Solver solver(problem);
  // The moment μ_t R* N slows it by 5/2 μ_t g/R.
  const double stops = 50 / (2.5 * 0.02 * g / 0.01);
  step(solver, 0.5 * stops);
  EXPECT_NEAR(solver.motions().spin[0].y(), 25, 1e-3 * 25);
  for (int i = 0; i < 5; ++i) step(solver, 0.5 * stops);
  EXPECT_NEAR(solver.motions().spin[0].y(), 0, 1e-3);
}

TEST(Friction, a_dropped_disc_comes_to_rest_with_little_overlap) {
  Problem problem = on_floor(material(1e6, 0.3, 0.3, 0.3), body("disc", "disc", 0.00125, 1250, {0, 0.005}));
  problem.thickness = 0.001;
  Solver solver(problem);
  for (int i = 0; i < 500; ++i) step(solver, 1e-3);
  const double overlap = 0.00125 - solver.motions().position[0].y();
  EXPECT_GT(overlap, 0);
  EXPECT_LT(overlap, 0.01 * 0.0025);
  EXPECT_LT(solver.motions().velocity[0].norm(), 1e-6);
}

}  // namespace
}  // namespace fpi::dem
