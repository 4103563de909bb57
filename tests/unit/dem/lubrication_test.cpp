/// Films of liquid between grains: the law against exact solutions, and its stiff, implicit
/// action.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "dem/lubrication/lubrication_law.hpp"
#include "grains.hpp"

namespace fpi::dem {
namespace {

using namespace test;
using std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A disc of radius 1 beside a wall moves at 4πμ/(α − tanh α) towards it, 4πμ/α along it, and turns at 4πμ
/// coth α, with cosh α = 1 + gap (Jeffrey & Onishi 1981), exactly.
TEST(LubricationLaw, of_a_disc_and_a_wall_is_the_exact_solution_of_narrow_gaps) {
  const GapShape shape = gap_shape(1, infinite);
  for (const double gap : {1e-4, 1e-3, 1e-2, 0.1, 0.25}) {
    const double alpha = std::acosh(1 + gap), mu = 0.7;
    const Resistance film = disc_film(mu, shape, gap);
    EXPECT_NEAR(film.normal / (4 * pi * mu / (alpha - std::tanh(alpha))), 1, 0.05 * gap * gap + 1e-9) << gap;
    const double along = film.sliding + film.rolling;  // a speed along the wall both slides and rolls
    EXPECT_NEAR(along / (4 * pi * mu / alpha), 1, 0.1 * gap) << gap;
    EXPECT_NEAR(along / (4 * pi * mu / std::tanh(alpha)), 1, 0.8 * gap) << gap;
  }
}

TEST(LubricationLaw, of_unequal_discs_tends_to_that_of_a_wall) {
  const Resistance wall = disc_film(1, gap_shape(1, infinite), 0.01);
  const Resistance large = disc_film(1, gap_shape(1, 1e9), 0.01);
  EXPECT_NEAR(large.normal / wall.normal, 1, 1e-8);
  EXPECT_NEAR(
      sphere_film(1, gap_shape(1, 1e9), 0.01).normal / sphere_film(1, gap_shape(1, infinite), 0.01).normal, 1,
      1e-8);
}

TEST(LubricationLaw, adds_nothing_to_a_resolved_gap_and_grows_without_a_jump) {
  for (const LubricationFilm law : {disc_film, sphere_film})
    for (const double other : {1.0, infinite})
      for (const double resolved : {0.25, 0.0}) {
        const GapShape shape = gap_shape(1, other);
        const double begin = resolved > 0 ? resolved : shape.radius;
        EXPECT_EQ(unresolved(law, 1, shape, begin, resolved).normal, 0);
        Resistance before = unresolved(law, 1, shape, begin, resolved);
        for (double gap = begin; gap > 1e-5; gap *= 0.99) {
          const Resistance film = unresolved(law, 1, shape, gap, resolved), whole = law(1, shape, gap);
          EXPECT_GE(film.normal, before.normal);
          EXPECT_GE(film.sliding, before.sliding);
          EXPECT_GE(film.rolling, before.rolling);
          EXPECT_LT(film.normal - before.normal, 0.03 * whole.normal);
          EXPECT_LT(film.sliding - before.sliding, 0.03 * law(1, shape, 1e-5).sliding);
          before = film;
        }
        EXPECT_NEAR(before.normal / law(1, shape, 1e-5).normal, 1, 0.01);
      }
}

/// Two discs, or a disc over a floor, of radius 0.1 m and mass m in a liquid of viscosity μ.
Problem disc_over_floor(double gap, double speed, double viscosity) {
  scene::Body disc = body("disc", "disc", 0.1, 1000, {0, 0.1 + gap}, {0, -speed});
  Problem problem = on_floor(material(1e7, 0.3), disc);
  problem.gravity.setZero();
  problem.dem.lubrication.viscosity = viscosity;
  return problem;
}

/// m dV/dt = −c(h) V with dh/dt = −V: what is left of the speed is V₀ − ∫ c dh/m.
TEST(Lubrication, takes_from_an_approach_the_integral_of_the_law_over_the_gap) {
  const double gap = 0.05, speed = 0.5, viscosity = 2;
  Solver solver(disc_over_floor(gap, speed, viscosity));
  const double mass = solver.model().bodies.mass[0];
  const GapShape shape = gap_shape(0.1, infinite);
  double work = 0, at = gap;
  for (int i = 0; i < 20; ++i) {
    step(solver, 0.005);
    const double now = solver.motions().position[0].y() - 0.1;
    constexpr int parts = 200;
    for (int k = 0; k < parts; ++k) {
      const double h = now + (at - now) * (k + 0.5) / parts;
      work += unresolved(disc_film, viscosity, shape, h, 0).normal * (at - now) / parts;
    }
    at = now;
    const double left = -solver.motions().velocity[0].y();
    EXPECT_NEAR(left, speed - work / mass, 0.01 * speed) << now;
  }
  EXPECT_LT(at, 0.03);
  EXPECT_GT(at, 0.002);
}

/// However stiff the film is against the step, a pressed disc sinks at the speed that the film allows.
TEST(Lubrication, lets_a_pressed_disc_sink_at_force_over_resistance) {
  for (const double viscosity : {1.0, 1e3, 1e6}) {
    Solver solver(disc_over_floor(0.01, 0, viscosity));
    const double c = unresolved(disc_film, viscosity, gap_shape(0.1, infinite), 0.01, 0).normal;
    const double rate = c / solver.model().bodies.mass[0], speed = 1e-7 * rate;  // little on the way
    const std::vector<Load> press{{0, {0, -c * speed, 0}, {}}};
    step(solver, 20 / rate, press);
    EXPECT_NEAR(-solver.motions().velocity[0].y() / speed, 1, 0.01) << viscosity;
    const double before = solver.motions().position[0].y();
    step(solver, 10 / rate, press);
    EXPECT_NEAR((before - solver.motions().position[0].y()) / (10 / rate * speed), 1, 0.01) << viscosity;
  }
}

TEST(Lubrication, holds_a_disc_off_the_floor_for_long_and_lets_it_touch_in_the_end) {
  Problem problem = disc_over_floor(0.002, 0, 10);
  problem.gravity = {0, -9.81, 0};
  problem.dem.lubrication.roughness = 0.005;
  Solver solver(problem);
  double gap = 0.002;
  for (int i = 0; i < 4; ++i) {
    step(solver, 0.005);
    EXPECT_LT(solver.motions().position[0].y() - 0.1, gap);
    gap = solver.motions().position[0].y() - 0.1;
    EXPECT_GT(gap, 0);
  }
  Advanced outcome;
  for (int i = 0; i < 400 && outcome.contacts == 0; ++i) outcome = step(solver, 0.005);
  EXPECT_EQ(outcome.contacts, 1);
  EXPECT_LT(std::abs(solver.motions().velocity[0].y()), 1e-3);
}

/// What a fluid that resolves gaps from 0.02 m on does not see.
TEST(Lubrication, acts_only_below_the_gap_that_the_fluid_resolves) {
  const std::vector<double> resolved{0.02};
  for (const auto& [gap, slows] : {std::pair{0.03, false}, std::pair{0.015, true}}) {
    Solver solver(disc_over_floor(gap, 1e-3, 1));
    ASSERT_TRUE(solver.advance(0.1, {}, {}, resolved).converged);
    EXPECT_EQ(solver.motions().velocity[0].y() > -1e-3, slows) << gap;
  }
  Solver solver(disc_over_floor(0.03, 1e-3, 1));
  EXPECT_THROW(solver.advance(0.1, {}, {}, std::vector<double>{0.0}), Error);
  EXPECT_THROW(solver.advance(0.1, {}, {}, std::vector<double>{0.1, 0.1}), Error);
}

/// The liquid sees smaller discs than touch: its gap is wider by what is left out of the radii.
TEST(Lubrication, measures_gaps_between_hydraulic_radii) {
  Problem problem = disc_over_floor(1e-3, 0, 1);
  problem.hydraulic_radius_ratio = 0.8;
  Solver solver(problem);
  const double c = unresolved(disc_film, 1, gap_shape(0.08, infinite), 0.021, 0).normal;
  step(solver, 200 * solver.model().bodies.mass[0] / c, std::vector<Load>{{0, {0, -1e-6, 0}, {}}});
  EXPECT_NEAR(-solver.motions().velocity[0].y() * c / 1e-6, 1, 0.01);
}

/// Grains of a cloud, some moving apart, spinning; no walls, nothing from outside.
Problem cloud(const std::string& shape) {
  const bool plane = shape == "disc";
  Problem problem;
  problem.materials = {material(1e6, 0.3)};
  problem.dem.lubrication.viscosity = 5;
  for (int i = 0; i < 27; ++i) {
    const double x = 0.205 * (i % 3), y = 0.21 * (i / 3 % 3), z = 0.2005 * (i / 9);
    const double v = 0.1 * (i % 5 - 2), w = 0.07 * (i % 7 - 3);
    problem.bodies.push_back(
        plane ? body("g" + std::to_string(i), shape, 0.1, 1000, {x + 0.7 * (i / 9), y}, {v, w})
              : body("g" + std::to_string(i), shape, 0.1, 1000, {x, y, z}, {v, w, 0.05 * (i % 2)}));
    problem.bodies.back().spin = plane ? std::vector{1.0 - i % 3} : std::vector{0.5, 1.0 - i % 3, 0.2 * i};
  }
  return problem;
}

TEST(Lubrication, keeps_momentum_and_only_loses_energy) {
  for (const std::string shape : {"disc", "sphere"}) {
    Solver solver(cloud(shape));
    const auto momenta = [&] {
      const Model& model = solver.model();
      const Motions& m = solver.motions();
      std::pair<Vec3, Vec3> sum{Vec3::Zero(), Vec3::Zero()};
      for (std::size_t i = 0; i < m.position.size(); ++i) {
        const Vec3 p = model.bodies.mass[i] * m.velocity[i];
        sum.first += p;
        sum.second += m.position[i].cross(p) + m.spin[i] / model.bodies.inverse_inertia[i];
      }
      return sum;
    };
    const auto [linear, angular] = momenta();
    const double first = energy(solver);
    double before = first;
    for (int i = 0; i < 30; ++i) {
      step(solver, 1e-3);
      EXPECT_LE(energy(solver), before * (1 + 1e-9)) << shape;
      before = energy(solver);
    }
    EXPECT_LT(before, 0.8 * first) << shape;
    const double scale = std::sqrt(first * 27 * solver.model().bodies.mass[0]);
    EXPECT_LT((momenta().first - linear).norm(), 1e-12 * scale) << shape;
    EXPECT_LT((momenta().second - angular).norm(), 1e-11 * scale) << shape;
  }
}

/// A pair in rigid rotation about its centre does not shear its film.
TEST(Lubrication, does_not_turn_a_disc_that_must_not) {
  Problem problem = disc_over_floor(0.01, 0.5, 2);
  problem.bodies[0].velocity = {0.3, -0.5};
  problem.bodies[0].rotates = false;
  Solver solver(problem);
  step(solver, 0.005);
  EXPECT_EQ(solver.motions().spin[0].norm(), 0);
  EXPECT_GT(solver.motions().velocity[0].x(), 0.1);
  EXPECT_LT(solver.motions().velocity[0].x(), 0.3);
}

TEST(Lubrication, leaves_a_rigid_rotation_alone) {
  Problem problem;
  problem.materials = {material(1e6, 0.3)};
  problem.dem.lubrication.viscosity = 100;
  problem.bodies = {body("a", "disc", 0.1, 1000, {-0.105, 0}, {0, -0.105}),
                    body("b", "disc", 0.1, 1000, {0.105, 0}, {0, 0.105})};
  for (auto& b : problem.bodies) b.spin = {1};
  Solver solver(problem);
  step(solver, 1e-4);
  EXPECT_NEAR(solver.motions().spin[0].z(), 1, 1e-6);
  EXPECT_NEAR(solver.motions().velocity[1].y(), 0.105, 1e-6);
}

TEST(Lubrication, is_repeated_bitwise_after_a_restore_and_a_checkpoint) {
  Solver solver(cloud("disc"));
  const std::vector<double> resolved(27, 0.02);
  ASSERT_TRUE(solver.advance(1e-3, {}, {}, resolved).converged);
  solver.accept();
  const auto bytes = solver.checkpoint();
  ASSERT_TRUE(solver.advance(1e-3, {}, {}, resolved).converged);
  const Motions first = solver.motions();
  ASSERT_TRUE(solver.advance(2e-4, {}, {}, resolved).converged);
  ASSERT_TRUE(solver.advance(1e-3, {}, {}, resolved).converged);
  EXPECT_TRUE(bitwise_equal(solver.motions(), first));
  Solver other(cloud("disc"));
  other.resume(bytes);
  ASSERT_TRUE(other.advance(1e-3, {}, {}, resolved).converged);
  EXPECT_TRUE(bitwise_equal(other.motions(), first));
}

}  // namespace
}  // namespace fpi::dem
