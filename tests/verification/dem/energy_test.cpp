/// The account of energies: it closes to round-off, causes take what theory says, and the error of the steps,
/// which has an entry of its own, goes to zero with them.
#include <gtest/gtest.h>

#include <iostream>

#include "core/error.hpp"
#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::step;

struct Account {
  double kinetic, potential, elastic, damping, friction, turning, films, left, loads, walls, numerical;
  double total() const {
    return kinetic + potential + elastic + damping + friction + turning + films + left - loads - walls -
           numerical;
  }
};

Account account(const Solver& solver) {
  const auto [kinetic, potential, elastic, damping, friction, turning, films, left, loads, walls, numerical] =
      solver.energies().value();
  return {kinetic, potential, elastic, damping, friction, turning, films, left, loads, walls, numerical};
}

Problem accounted(Problem problem) {
  problem.dem.energy = true;
  return problem;
}

/// A ball that bounces on a floor for half a second.
Problem bouncing(double restitution, double steps_per_contact = 50) {
  Problem problem = accounted(test::on_floor(material(1e7, 0.3, restitution),
                                             body("b", "sphere", 0.01, 2500, {0, 0.06, 0}, {0, 0, 0})));
  problem.dem.steps_per_contact = steps_per_contact;
  return problem;
}

TEST(Energy, of_bouncing_spheres_closes_to_round_off_and_damping_takes_what_restitution_leaves) {
  for (const double e : {1.0, 0.9, 0.5}) {
    Solver solver(bouncing(e));
    const double start = account(solver).total(), input = 9.81 * 0.05 * solver.model().bodies.mass[0];
    for (int i = 0; i < 50; ++i) {
      step(solver, 0.01);
      EXPECT_NEAR(account(solver).total(), start, 1e-13 * input);
    }
    const Account end = account(solver);
    std::cout << fmt::format("e = {}: numerical {:.1e} of the input\n", e, end.numerical / input);
    EXPECT_LT(std::abs(end.numerical), (e < 1 ? 1e-3 : 2e-6) * input) << e;
    EXPECT_GE(end.damping, 0.9 * (1 - e * e) * input) << e;
    EXPECT_TRUE(e < 1 || end.damping == 0);
  }
}

TEST(Energy, that_the_steps_add_goes_to_zero_with_them) {
  const auto added = [](double steps) {
    Solver solver(bouncing(0.5, steps));
    step(solver, 0.15);  // one impact
    return std::abs(account(solver).numerical) / (9.81 * 0.05 * solver.model().bodies.mass[0]);
  };
  for (const double steps : {50.0, 100.0, 200.0, 400.0, 800.0, 1600.0})
    std::cout << fmt::format("t_c/{}: numerical {:.2e} of the input\n", steps, added(steps));
  EXPECT_LT(added(1600), 1e-6);
  EXPECT_GT(std::log2(added(100) / added(400)) / 2, 1.8);
}

TEST(Energy, of_a_sphere_that_slides_until_it_rolls_goes_to_friction_by_two_sevenths) {
  const scene::Material m = material(1e7, 0.3, 0.2, 0.3);
  Problem problem = accounted(test::on_floor(m, body("b", "sphere", 0.01, 2500, {0, 0.01, 0}, {0.5, 0, 0})));
  const double mass = 2500 * problem.bodies[0].volume(0.01, 1);
  problem.bodies[0].position[1] -=
      std::pow(9.81 * mass / Hertz::stiffness(combine(m, m).normal, 0.01), 2.0 / 3);
  Solver solver(problem);
  const double start = account(solver).total(), input = 0.5 * mass * 0.25;
  for (int i = 0; i < 50; ++i) step(solver, 0.01);
  const Account end = account(solver);
  EXPECT_NEAR(end.total(), start, 1e-13 * input);
  EXPECT_NEAR(end.friction / (2.0 / 7 * input), 1, 1e-6);
  EXPECT_NEAR(end.kinetic / (5.0 / 7 * input), 1, 1e-6);
  EXPECT_LT(std::abs(end.numerical), 1e-6 * input);
  EXPECT_LT(std::abs(end.walls) + std::abs(end.loads) + std::abs(end.films) + std::abs(end.turning),
            1e-12 * input);
}

/// A hundred spheres of several sizes in a column that falls apart, with all that contacts can resist with.
Problem column() {
  Problem problem;
  problem.gravity = {0, 0, -9.81};
  problem.materials = {material(1e7, 0.3, 0.6, 0.5, 0.05), material(3e7, 0.25, 0.8, 0.4, 0.02)};
  for (auto& m : problem.materials) m.twisting_friction = 0.02;
  problem.walls = {test::wall("floor", {0, 0, 0}, {0, 0, 1}), test::wall("side", {-0.011, 0, 0}, {1, 0, 0})};
  for (int i = 0; i < 100; ++i) {
    const double x = 0.021 * (i % 3), y = 0.021 * (i / 3 % 3), z = 0.0105 + 0.021 * (i / 9);
    problem.bodies.push_back(body("g" + std::to_string(i), "sphere", 0.008 + 0.0005 * (i % 5), 2500,
                                  {x + 1e-4 * (i % 4), y - 1e-4 * (i % 7), z}, {0, 0, 0}));
    problem.bodies.back().spin = {0, 0, 0};
    problem.bodies.back().material = problem.materials[std::size_t(i % 2)].name;
  }
  return problem;
}

TEST(Energy, of_the_collapse_of_a_hundred_grains_closes_and_does_not_change_their_motion) {
  Solver solver(accounted(column())), plain(column());
  const Account start = account(solver);
  double mass = 0;
  for (const double m : solver.model().bodies.mass) mass += m;
  const double input = start.potential;  // above the floor
  Account last = start;
  for (int i = 0; i < 25; ++i) {
    step(solver, 0.02);
    step(plain, 0.02);
    const Account now = account(solver);
    EXPECT_NEAR(now.total(), start.total(), 1e-12 * input);
    for (const double lost :
         {now.damping - last.damping, now.friction - last.friction, now.turning - last.turning})
      EXPECT_GT(lost, -1e-4 * input);
    last = now;
  }
  EXPECT_TRUE(test::bitwise_equal(solver.motions(), plain.motions()));
  std::cout << fmt::format(
      "collapse: kinetic {:.3g} potential {:.4g} elastic {:.2g} damping {:.3g} friction {:.3g} "
      "turning {:.3g} numerical {:.2g} of the input\n",
      last.kinetic / input, last.potential / input, last.elastic / input, last.damping / input,
      last.friction / input, last.turning / input, last.numerical / input);
  EXPECT_GT(last.damping, 0.02 * input);
  EXPECT_GT(last.friction, 0.02 * input);
  EXPECT_GT(last.turning, 0.001 * input);
  EXPECT_LT(std::abs(last.numerical), 1e-3 * input);
}

TEST(Energy, of_loads_walls_and_prescribed_bodies_is_their_work) {
  Problem problem = accounted({});
  problem.materials = {material(1e9, 0.3)};
  problem.bodies = {body("pushed", "sphere", 0.01, 2500, {0, 0.4, 0}, {0, 0, 0}),
                    body("free", "sphere", 0.01, 2500, {0, 0.2, 0}, {0, 0, 0}),
                    body("bat", "sphere", 0.01, 2500, {-0.0205, 0.2, 0}, {0, 0, 0}),
                    body("struck", "sphere", 0.01, 2500, {0, 0, 0}, {0, 0, 0})};
  problem.bodies[2].motion = "prescribed";
  problem.bodies[2].prescribed_velocity = {"1", "0", "0"};
  scene::Wall wall = test::wall("piston", {0, -0.0105, 0}, {0, 1, 0});
  wall.velocity = {"0", "1", "0"};
  problem.walls = {wall};
  Solver solver(problem);
  const double mass = solver.model().bodies.mass[0];
  const Load load{.body = 0, .force = {0, 0, 3}, .torque = {0, 0, 1e-3}};
  const Prescribed bat{.body = 2, .position = {-0.0205 + 0.01, 0.2, 0}, .velocity = {1, 0, 0}};
  const Prescribed piston{.body = 0, .position = {0, 0.01, 0}, .velocity = {0, 1, 0}};
  ASSERT_TRUE(solver.advance(0.01, {&load, 1}, {&bat, 1}, {}, {&piston, 1}).converged);
  solver.accept();
  const Account end = account(solver);
  const Motions& m = solver.motions();
  EXPECT_NEAR(m.velocity[1].x(), 2, 1e-3);
  EXPECT_NEAR(m.velocity[3].y(), 2, 1e-3);
  EXPECT_NEAR(end.loads,
              3 * m.position[0].z() + 0.5 * solver.model().bodies.inertia[0] * m.spin[0].squaredNorm(),
              1e-15);
  EXPECT_NEAR(end.walls / (0.5 * mass * (m.velocity[1].squaredNorm() + m.velocity[3].squaredNorm())), 1,
              1e-6);
  EXPECT_NEAR(end.total(), 0, 1e-15);
}

/// Grains that stick, are pulled by fields, squeeze films between them and are turned by a drum.
TEST(Energy, of_attractions_and_films_closes_and_comes_back_bitwise_from_a_checkpoint) {
  Problem problem = accounted(test::box_of_discs());
  problem.materials[0].adhesion = 0.1;
  problem.dem.near_field = {.attraction = 1e-4,
                            .attraction_exponent = 2,
                            .repulsion = 1e-7,
                            .repulsion_exponent = 4,
                            .cut_off = 0.05};
  problem.dem.lubrication.viscosity = 0.1;
  Solver solver(problem);
  const double start = account(solver).total();
  for (int i = 0; i < 20; ++i) step(solver, 5e-3);
  const Account now = account(solver);
  EXPECT_NEAR(now.total(), start, 1e-12 * std::abs(now.damping + now.friction + now.films));
  EXPECT_GT(now.films, 0.01 * now.damping);
  Solver resumed(problem);
  resumed.resume(solver.checkpoint());
  step(solver, 5e-3);
  step(resumed, 5e-3);
  EXPECT_EQ(solver.energies(), resumed.energies());
  const auto accepted = solver.energies();
  solver.advance(1e-2, {});
  solver.restore();
  EXPECT_EQ(solver.energies(), accepted);
}

TEST(Energy, goes_with_the_grains_that_leave_and_with_their_contacts) {
  Solver solver(accounted(test::box_of_discs()));
  const double start = account(solver).total();
  for (int i = 0; i < 100; ++i) step(solver, 2e-3);
  const Account before = account(solver);
  ASSERT_TRUE(solver.advance(2e-3, {}).converged);
  solver.accept(std::vector<std::uint32_t>{2, 7});
  for (int i = 0; i < 20; ++i) step(solver, 2e-3);
  const Account now = account(solver);
  EXPECT_EQ(before.left, 0);
  EXPECT_GT(now.left, 0);
  EXPECT_NEAR(now.total(), start, 1e-12 * std::abs(start));
  const double input = now.damping + now.friction;
  EXPECT_NEAR(now.numerical, before.numerical, 1e-3 * input) << "no energy is made up";
}

TEST(Energy, is_not_accounted_for_unless_asked) {
  EXPECT_FALSE(Solver(test::box_of_discs()).energies().has_value());
}

}  // namespace
}  // namespace fpi::dem
