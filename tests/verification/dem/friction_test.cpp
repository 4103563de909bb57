/// Coulomb's law and Mindlin's spring against what statics and rigid-body dynamics say.
#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::step;

constexpr double g = 9.81, R = 0.01, mu = 0.3;

/// A sphere or disc that rests on the floor where the contact bears its weight.
Problem resting(const std::string& shape, double restitution = 0.2) {
  const scene::Material m = material(1e7, 0.3, restitution, mu);
  Problem problem = test::on_floor(m, body("b", shape, R, 2500, {0, R, 0}, {0, 0, 0}));
  problem.thickness = R;
  const double weight = g * 2500 * problem.bodies[0].volume(R, problem.thickness);
  problem.bodies[0].position[1] -= std::pow(weight / Hertz::stiffness(combine(m, m).normal, R), 2.0 / 3);
  return problem;
}

Problem block() {
  Problem problem = resting("sphere");
  problem.bodies[0].rotates = false;
  return problem;
}

double weight(const Solver& solver) { return g * solver.model().bodies.mass[0]; }

/// A block pushed along x by a share of the limit of friction, with a force that grows for 0.1 s and stays.
struct PushedBlock {
  Solver solver{block()};
  double force;
  Load load;

  PushedBlock(double share, double settling_time) : force(share * mu * weight(solver)) {
    for (int i = 1; i <= 100; ++i) {
      load = {.body = 0, .force = {force * i / 100, 0, 0}};
      advance(1e-3);
    }
    load = {.body = 0, .force = {force, 0, 0}};
    advance(settling_time);
  }
  Advanced advance(double duration) { return step(solver, duration, {&load, 1}); }
};

TEST(Friction, a_block_pushed_with_99_percent_of_the_limit_stays_for_a_million_sub_steps) {
  PushedBlock pushed(0.99, 0.1);
  const Solver& solver = pushed.solver;
  const double x = solver.motions().position[0].x();
  std::uint64_t sub_steps = 0;
  while (sub_steps < 1000000) sub_steps += pushed.advance(1).sub_steps;
  EXPECT_NEAR(solver.motions().position[0].x() / x, 1, 1e-12);
  EXPECT_LT(solver.motions().velocity[0].norm(), 1e-15);
}

TEST(Friction, a_block_pushed_with_101_percent_of_the_limit_slides_with_the_acceleration_that_is_left) {
  PushedBlock pushed(1.01, 0.5);
  const Solver& solver = pushed.solver;
  const double before = solver.motions().velocity[0].x();
  pushed.advance(1);
  EXPECT_NEAR((solver.motions().velocity[0].x() - before) / (0.01 * mu * g), 1, 1e-9);
}

TEST(Friction, a_push_below_the_limit_moves_a_block_by_force_over_stiffness) {
  const PushedBlock pushed(0.4, 0.5);
  const auto& [solver, force, load] = pushed;
  const double overlap = R - solver.motions().position[0].y();
  const Near at = near(solver.model(), solver.motions().position, solver.walls(), WallPlace{0, 0});
  const Normal state{.mass = 1, .radius = R, .overlap = overlap, .rate = 0};
  const double stiffness = tangential_spring<Hertz>(at.law, state, Hertz::slope(overlap)).stiffness;
  EXPECT_NEAR(solver.motions().position[0].x() * stiffness / force, 1, 1e-6);
}

TEST(Friction, sliding_ends_in_rolling_at_the_speed_of_theory) {
  for (const auto& [shape, share, over] :
       {std::tuple{"sphere", 5.0 / 7, 7.0 / 2}, std::tuple{"disc", 2.0 / 3, 3.0}}) {
    Problem problem = resting(shape);
    problem.bodies[0].velocity = {0.5, 0, 0};
    Solver solver(problem);
    step(solver, 2 * 0.5 / (over * mu * g));
    for (int i = 0; i < 5; ++i) step(solver, 0.1);
    EXPECT_NEAR(solver.motions().velocity[0].x() / (0.5 * share), 1, 1e-6) << shape;
    EXPECT_NEAR(-solver.motions().spin[0].z() * R / (0.5 * share), 1, 1e-6) << shape;
  }
}

}  // namespace
}  // namespace fpi::dem
