/// Impacts along the normal against Hertz's theory and the benchmarks of Chung & Ooi (2011).
#include <gtest/gtest.h>

#include <cmath>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::rigid;

struct Impact {
  double peak_force = 0;    ///< [N]
  double peak_overlap = 0;  ///< [m]
  double duration = 0;      ///< [s]
  double restitution = 0;
};

/// Follows the first pair, or the body and the wall, of a set-up over 1.5 of its contact time t_c [s], in
/// sub-steps of t_c/50.
Impact follow(const Problem& problem, double t_c) {
  Solver solver(problem);
  const Motions& motions = solver.motions();
  const Model& model = solver.model();
  const auto state = [&] {
    const bool wall = model.bodies.size() == 1;
    return normal_state(model,
                        wall ? near(model, motions.position, solver.walls(), WallPlace{0, 0})
                             : near(model, motions.position, Pair{0, 1}),
                        motions.velocity);
  };
  const double dt = t_c / 50 * (1 - 1e-9);
  const Normal start = state();
  Impact impact;
  for (int i = 1; i < 75; ++i) {
    const Vec3 velocity_before = motions.velocity[0];
    const double overlap_before = state().overlap;
    impact.peak_overlap = std::max(impact.peak_overlap, test::step(solver, dt).largest_overlap);
    const Normal now = state();
    const double force = model.bodies.mass[0] * (motions.velocity[0] - velocity_before).norm() / dt;
    impact.peak_force = std::max(impact.peak_force, force);
    const bool parted = overlap_before > 0 && now.overlap <= 0;
    if (parted) impact.duration = i * dt - now.overlap / now.rate + start.overlap / start.rate;
  }
  impact.restitution = -state().rate / start.rate;
  return impact;
}

/// Two spheres that meet head-on with ± speed after a gap of `gap` on either side.
Problem head_on(const scene::Material& m, double radius, double density, double speed, double gap) {
  Problem problem;
  problem.materials = {m};
  const double x = radius + gap;
  problem.bodies = {body("left", "sphere", radius, density, {-x, 0, 0}, {speed, 0, 0}),
                    body("right", "sphere", radius, density, {x, 0, 0}, {-speed, 0, 0})};
  return problem;
}

double sphere_mass(double radius, double density) {
  return density * 4 / 3 * std::numbers::pi * radius * radius * radius;
}

TEST(Impact, undamped_contact_time_and_restitution_are_hertz_at_any_phase) {
  const scene::Material m = material(1e9, 0.3);
  const double t_c = contact_time(0.5 * sphere_mass(0.01, 2500), 0.005, combine(m, m).normal, 2);
  for (const double phase : {0.0, 0.3, 0.7}) {
    const Impact impact = follow(head_on(m, 0.01, 2500, 1, phase * t_c / 50), t_c);
    EXPECT_NEAR(impact.duration / t_c, 1, 1.2e-4) << phase;  // the first force of a step is of second order
    EXPECT_NEAR(impact.restitution, 1, 4e-6) << phase;
  }
}

/// Head-on at 1 m/s each, first touching at `phase` of a sub-step of t_c/50.
double restitution_had(const std::string& law, double e, double phase) {
  scene::Material m = material(1e9, 0.3, e);
  m.normal_stiffness = 1e6;
  Problem problem = head_on(m, 0.01, 2500, 1, 0);
  problem.dem.contact = law;
  const Elasticity elasticity = make_model(problem).elasticity;
  const Normal start{.mass = 0.5 * sphere_mass(0.01, 2500), .radius = 0.005, .overlap = 0, .rate = 2};
  const double t_c = contact_time(elasticity, combine(m, m, elasticity), start);
  problem.bodies[0].position[0] -= (1 + phase) * t_c / 50;
  problem.bodies[1].position[0] += (1 + phase) * t_c / 50;
  Solver solver(problem);
  for (int i = 0; i < 150; ++i) test::step(solver, t_c / 50);
  return -solver.motions().velocity[0].x();
}

TEST(Impact, restitution_asked_for_is_had_at_any_phase) {
  for (const char* law : {"hertz", "linear"}) {
    for (const double e : {0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 1.0}) {
      for (const double phase : {0.0, 0.25, 0.5, 0.75, 0.9}) {
        EXPECT_NEAR(restitution_had(law, e, phase), e, 1e-3) << law << " " << phase;
      }
    }
  }
}

TEST(Impact, a_linear_spring_takes_half_a_period_at_any_speed) {
  scene::Material m = material(0, 0.3);
  m.normal_stiffness = 2e6;
  const double t_c = std::numbers::pi * std::sqrt(0.5 * sphere_mass(0.01, 2500) / 2e6);
  for (const double speed : {0.01, 1.0}) {
    Problem problem = head_on(m, 0.01, 2500, speed, 0.4 * speed * t_c / 50);
    problem.dem.contact = "linear";
    const Impact impact = follow(problem, t_c);
    EXPECT_NEAR(impact.duration / t_c, 1, 1e-4);
    EXPECT_NEAR(impact.restitution, 1, 4e-5);
  }
}

TEST(Impact, restitution_is_the_same_at_every_speed_and_on_a_wall) {
  for (const double speed : {1e-3, 1.0, 30.0}) {
    Problem problem;
    problem.materials = {material(1e9, 0.3, 0.6)};
    problem.walls = {test::wall("floor", {0, 0, 0}, {0, 1, 0})};
    problem.bodies = {body("ball", "sphere", 0.01, 2500, {0, 0.0101, 0}, {0, -speed, 0})};
    Solver solver(problem);
    test::step(solver, 4e-4 / speed + 2e-4);
    EXPECT_NEAR(solver.motions().velocity[0].y() / speed, 0.6, 1e-3) << speed;
  }
}

/// Peak overlaps, speeds after the impact and sub-steps of balls that fall on a floor.
TEST(Impact, stretched_contacts_last_and_overlap_k_times_as_much_and_rebound_alike) {
  for (const std::string contact : {"hertz", "linear"}) {
    const auto fall = [&](double stretch, double duration) {
      Problem problem;
      problem.materials = {material(1e9, 0.3, 0.6)};
      problem.materials[0].normal_stiffness = 1e6;
      problem.dem.contact = contact;
      problem.dem.stretch = stretch;
      problem.walls = {test::wall("floor", {0, 0, 0}, {0, 1, 0})};
      problem.bodies = {body("ball", "sphere", 0.01, 2500, {0, 0.01 + 1e-8, 0}, {0, -1, 0})};
      Solver solver(problem);
      const Advanced outcome = test::step(solver, duration);
      return std::tuple{outcome.largest_overlap, solver.motions().velocity[0].y(), double(outcome.contacts)};
    };
    const double t_c = contact == "hertz" ? 3.7e-4 : 3.2e-4;
    const auto [overlap, speed, touching] = fall(1, 1.5 * t_c);
    const auto [wide, same, parted] = fall(4, 6 * t_c);
    EXPECT_EQ(touching + parted, 0);
    EXPECT_NEAR(wide / overlap, 4, 0.01) << contact;
    EXPECT_NEAR(speed, 0.6, 3e-3) << contact;
    EXPECT_NEAR(same, speed, 1e-3) << contact;
    for (const double share : {0.2, 0.4, 0.6})  // the same motion, four times slower
      EXPECT_NEAR(std::get<1>(fall(4, 4 * share * t_c)), std::get<1>(fall(1, share * t_c)), 5e-3)
          << contact << share;
  }
}

TEST(Impact, chung_and_ooi_1_elastic_spheres) {
  struct Case {
    double modulus, poisson, density, force, overlap, duration;
  };
  for (const Case& c : {Case{48e9, 0.2, 2800, 10.697e3, 274.1e-6, 40.34e-6},
                        Case{20e9, 0.25, 2500, 7.108e3, 368.3e-6, 54.20e-6}}) {
    const Impact impact = follow(head_on(material(c.modulus, c.poisson), 0.01, c.density, 10, 0), c.duration);
    EXPECT_NEAR(impact.peak_force / c.force, 1, 3e-3);
    EXPECT_NEAR(impact.peak_overlap / c.overlap, 1, 3e-3);
    EXPECT_NEAR(impact.duration / c.duration, 1, 3e-3);
  }
}

TEST(Impact, chung_and_ooi_2_elastic_sphere_on_a_rigid_wall) {
  Problem problem;
  problem.materials = {material(70e9, 0.3), rigid(material(70e9, 0.3))};
  problem.walls = {test::wall("wall", {0, 0, 0}, {0, 1, 0}, "rigid")};
  problem.bodies = {body("ball", "sphere", 0.1, 2699, {0, 0.1, 0}, {0, -0.2, 0})};
  const Impact impact = follow(problem, 731.6e-6);
  EXPECT_NEAR(impact.peak_force / 11.37e3, 1, 3e-3);
  EXPECT_NEAR(impact.peak_overlap / 49.72e-6, 1, 3e-3);
  EXPECT_NEAR(impact.duration / 731.6e-6, 1, 3e-3);
}

TEST(Impact, head_on_collision_conserves_momentum) {
  Problem problem = head_on(material(1e8, 0.3, 0.5, 0.4), 0.01, 2500, 1, 1e-4);
  problem.bodies[1].radius = 0.007;
  problem.bodies[1].velocity = {-3, 0.5, 0.2};
  problem.bodies[0].spin = {10, 20, 30};
  Solver solver(problem);
  const Bodies& bodies = solver.model().bodies;
  const Motions& m = solver.motions();
  const auto momentum = [&] { return Vec3(bodies.mass[0] * m.velocity[0] + bodies.mass[1] * m.velocity[1]); };
  const auto angular = [&] {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 2; ++i) {
      sum += bodies.mass[i] * m.position[i].cross(m.velocity[i]) + m.spin[i] / bodies.inverse_inertia[i];
    }
    return sum;
  };
  const Vec3 momentum_before = momentum(), angular_before = angular(), spin_before = m.spin[0];
  test::step(solver, 0.01);
  EXPECT_GT((m.spin[0] - spin_before).norm(), 1);
  EXPECT_LT((momentum() - momentum_before).norm(), 1e-14 * bodies.mass[0]);
  EXPECT_LT((angular() - angular_before).norm(), 1e-13 * angular_before.norm());
}

}  // namespace
}  // namespace fpi::dem
