#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::step;

Problem one_body(const std::string& shape) {
  Problem problem;
  problem.gravity = {0, -9.81, 0};
  problem.thickness = 0.5;
  problem.bodies = {body("b", shape, 0.1, 1000, {0.2, 3}, {1, 2})};
  return problem;
}

TEST(Motion, free_fall_is_exact_in_one_step) {
  Solver solver(one_body("disc"));
  const Advanced outcome = step(solver, 0.25);
  EXPECT_EQ(outcome.sub_steps, 1u);
  EXPECT_NEAR(solver.motions().velocity[0].y(), 2 - 9.81 * 0.25, 1e-15);
  EXPECT_NEAR(solver.motions().position[0].y(), 3 + 2 * 0.25 - 0.5 * 9.81 * 0.0625, 1e-15);
  EXPECT_NEAR(solver.motions().position[0].x(), 0.45, 1e-15);
}

TEST(Motion, a_load_accelerates_disc_and_sphere_by_their_mass_and_inertia) {
  const double disc = 1000 * std::numbers::pi * 0.01 * 0.5,
               sphere = 1000 * 4.0 / 3 * std::numbers::pi * 0.001;
  for (const auto& [shape, mass, factor] :
       {std::tuple{"disc", disc, 0.5}, std::tuple{"sphere", sphere, 0.4}}) {
    Solver solver(one_body(shape));
    const Load load{.body = 0, .force = {3, 0, 0}, .torque = {0, 0, 0.7}};
    step(solver, 0.1, std::span(&load, 1));
    EXPECT_NEAR(solver.motions().velocity[0].x(), 1 + 0.3 / mass, 1e-14);
    EXPECT_NEAR(solver.motions().spin[0].z(), 0.07 / (factor * mass * 0.01), 1e-12);
  }
}

/// A fluid that would exert 3 N on a body that ends with 2 m/s, and resists others with 5 kg.
TEST(Motion, added_inertia_changes_nothing_where_the_body_ends_as_the_fluid_has_it) {
  const double mass = 1000 * std::numbers::pi * 0.01 * 0.5, time_step = 0.1;
  Solver solver(one_body("disc"));
  Load load{.body = 0, .force = {mass * (2 - 1) / time_step, 0, 0}, .velocity = {2, 0, 0}, .added_mass = 5};
  step(solver, time_step, std::span(&load, 1));
  EXPECT_NEAR(solver.motions().velocity[0].x(), 2, 1e-14);
  Solver pushed(one_body("disc"));
  load.force.x() += 7;
  step(pushed, time_step, std::span(&load, 1));
  EXPECT_NEAR(pushed.motions().velocity[0].x(), 2 + 7 * time_step / (mass + 5), 1e-14);
}

TEST(Motion, a_massless_body_moves_with_the_inertia_that_the_fluid_adds_and_not_without) {
  Problem problem = one_body("disc");
  problem.bodies[0].density = 0;
  Solver solver(problem);
  EXPECT_THROW(step(solver, 0.1), Error);
  const Load load{.body = 0, .force = {4, 0, 0}, .velocity = {2, 0, 0}, .added_mass = 5, .added_inertia = 1};
  step(solver, 0.1, std::span(&load, 1));
  EXPECT_NEAR(solver.motions().velocity[0].x(), 2 + 4 * 0.1 / 5, 1e-14);
}

TEST(Motion, a_disc_stays_in_its_plane) {
  Solver solver(one_body("disc"));
  const Load load{.body = 0, .force = {0, 0, 5}, .torque = {1, 2, 3}};
  step(solver, 0.1, std::span(&load, 1));
  EXPECT_EQ(solver.motions().position[0].z(), 0);
  EXPECT_EQ(solver.motions().velocity[0].z(), 0);
  EXPECT_EQ(solver.motions().spin[0].head<2>().norm(), 0);
}

TEST(Motion, a_free_spin_turns_by_spin_times_time) {
  Problem problem = one_body("sphere");
  problem.bodies[0].spin = {2, -1, 3};
  Solver solver(problem);
  for (int i = 0; i < 1000; ++i) step(solver, 0.01);
  const Vec3 theta(20, -10, 30);
  const Eigen::Matrix3d exact = Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix();
  EXPECT_LT((solver.motions().orientation[0].base.toRotationMatrix() - exact).norm(), 1e-12);
}

TEST(Motion, a_prescribed_body_goes_where_it_is_told_and_pushes_what_it_meets) {
  Problem problem;
  problem.materials = {material(1e10, 0.3)};
  problem.bodies = {body("piston", "disc", 0.1, 0, {0, 0}), body("free", "disc", 0.1, 1000, {0.21, 0})};
  problem.bodies[0].motion = "prescribed";
  problem.bodies[0].prescribed_velocity = {"1", "0"};
  Solver solver(problem);
  const Prescribed end{.body = 0, .position = {0.02, 0, 0}, .velocity = {1, 0, 0}};
  const Advanced outcome = solver.advance(0.02, {}, std::span(&end, 1));
  ASSERT_TRUE(outcome.converged);
  EXPECT_EQ(solver.motions().position[0], end.position);
  EXPECT_EQ(solver.motions().velocity[0], end.velocity);
  EXPECT_NEAR(solver.motions().velocity[1].x(), 2, 1e-3);  // an elastic wall at 1 m/s doubles its speed
}

TEST(Motion, a_fixed_body_is_not_moved_by_an_impact) {
  Problem problem;
  problem.materials = {material(1e10, 0.3)};
  problem.bodies = {body("post", "disc", 0.1, 0, {0, 0}),
                    body("free", "disc", 0.1, 1000, {0.21, 0}, {-1, 0})};
  problem.bodies[0].motion = "fixed";
  Solver solver(problem);
  step(solver, 0.05);
  EXPECT_EQ(solver.motions().position[0], Vec3::Zero());
  EXPECT_EQ(solver.motions().velocity[0], Vec3::Zero());
  EXPECT_NEAR(solver.motions().velocity[1].x(), 1, 1e-4);
}

TEST(Motion, sub_steps_are_taken_only_while_something_touches) {
  Problem problem = test::on_floor(material(1e8, 0.3), body("ball", "sphere", 0.01, 2500, {0, 1.01, 0}));
  Solver solver(problem);
  std::uint64_t flying = 0;
  for (int i = 0; i < 44; ++i) flying += step(solver, 0.01).sub_steps;  // it meets the floor at 0.4515 s
  EXPECT_EQ(flying, 44u);
  EXPECT_GT(step(solver, 0.01).sub_steps + step(solver, 0.01).sub_steps, 50u);
  EXPECT_GT(solver.motions().velocity[0].y(), 0);
  EXPECT_EQ(step(solver, 0.01).sub_steps, 1u);
}

}  // namespace
}  // namespace fpi::dem
