/// Forces that need no contact, against their own potentials and the paths that these allow.
#include "dem/contact/attraction.hpp"

#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;

/// Two spheres of R = 1 cm a `distance` apart.
Problem two_spheres(double distance, double speed = 0, double adhesion = 0) {
  Problem problem;
  problem.materials = {material(1e7, 0.3)};
  problem.materials[0].adhesion = adhesion;
  problem.bodies = {body("a", "sphere", 0.01, 2500, {0, 0, 0}, {0, 0, 0}),
                    body("b", "sphere", 0.01, 2500, {distance, 0, 0}, {-speed, 0, 0})};
  return problem;
}

Problem in_near_field(double distance, double speed = 0) {
  Problem problem = two_spheres(distance, speed);
  problem.dem.near_field = {.attraction = 2e-4,
                            .attraction_exponent = 1,
                            .repulsion = 6e-6,
                            .repulsion_exponent = 2,
                            .cut_off = 0.08};
  return problem;
}

double force_at(const Problem& problem) {
  const Model model = make_model(problem);
  return attraction(model, near(model, initial_motions(problem).position, Pair{0, 1}));
}

double energy_at(const Problem& problem) {
  const Model model = make_model(problem);
  return attraction_energy(model, near(model, initial_motions(problem).position, Pair{0, 1}));
}

TEST(Attraction, near_field_is_the_law_of_the_paper_up_to_its_cut_off) {
  EXPECT_NEAR(force_at(in_near_field(0.05)), 2e-4 / 0.05 - 6e-6 / (0.05 * 0.05), 1e-15);
  EXPECT_NEAR(force_at(in_near_field(0.03)), 0, 1e-15);  // d = κ₂/κ₁
  EXPECT_LT(force_at(in_near_field(0.025)), 0);
  EXPECT_EQ(force_at(in_near_field(0.0800001)), 0);
}

TEST(Attraction, adhesion_pulls_as_jkr_while_surfaces_touch_and_ends_at_its_range) {
  const double pull_off = 1.5 * std::numbers::pi * 0.2 * 0.005;
  EXPECT_NEAR(force_at(two_spheres(0.01995, 0, 0.2)) / pull_off, 1, 1e-12);
  EXPECT_NEAR(force_at(two_spheres(0.02 + 0.5 * 0.01 * 0.005, 0, 0.2)) / pull_off, 0.5, 1e-9);
  EXPECT_EQ(force_at(two_spheres(0.02 + 1.01 * 0.01 * 0.005, 0, 0.2)), 0);
}

TEST(Attraction, forces_are_the_slopes_of_their_energies) {
  const double step = 1e-8;
  for (const double d : {0.01998, 0.02001, 0.02002, 0.03, 0.05, 0.07}) {
    for (const auto& at :
         {+[](double x) { return in_near_field(x); }, +[](double x) { return two_spheres(x, 0, 0.2); }}) {
      const double slope = (energy_at(at(d + step)) - energy_at(at(d - step))) / (2 * step);
      EXPECT_NEAR(slope, force_at(at(d)), 1e-6 * std::abs(force_at(at(d))) + 1e-12) << d;
    }
  }
  EXPECT_EQ(energy_at(in_near_field(0.0800001)), 0);
}

TEST(Attraction, spheres_in_a_near_field_keep_energy_and_momentum) {
  const Problem problem = in_near_field(0.06, 0.01);
  Solver solver(problem);
  const Motions& m = solver.motions();
  const auto total = [&] {
    return test::energy(solver) +
           attraction_energy(solver.model(), near(solver.model(), m.position, Pair{0, 1}));
  };
  const double before = total();
  for (int i = 0; i < 200; ++i) test::step(solver, 0.05);
  EXPECT_NEAR(total() / before, 1, 1e-3);
  EXPECT_NEAR(m.velocity[0].x() + m.velocity[1].x(), -0.01, 1e-14);
  EXPECT_GT(m.velocity[0].x(), 0);
}

TEST(Attraction, spheres_that_stick_bear_what_pulls_less_than_the_pull_off_force) {
  const double pull_off = 1.5 * std::numbers::pi * 0.2 * 0.005;
  for (const double share : {0.98, 1.02}) {
    Problem problem = two_spheres(0.02, 0, 0.2);
    problem.materials[0].restitution = 0.5;
    Solver solver(problem);
    for (int i = 0; i < 400; ++i) test::step(solver, 1e-3);
    const std::array loads = {Load{.body = 0, .force = {-share * pull_off, 0, 0}},
                              Load{.body = 1, .force = {share * pull_off, 0, 0}}};
    for (int i = 0; i < 200; ++i) {
      // Slowly, so that the spheres do not swing.
      const double part = std::min(1.0, i / 150.0);
      const std::array now = {Load{.body = 0, .force = part * loads[0].force},
                              Load{.body = 1, .force = part * loads[1].force}};
      test::step(solver, 1e-3, now);
    }
    const double distance = solver.motions().position[1].x() - solver.motions().position[0].x();
    EXPECT_EQ(distance > 0.0201, share > 1) << share;
  }
}

TEST(Attraction, bodies_that_are_far_apart_find_each_other_by_their_near_field) {
  Problem problem = in_near_field(0.079);
  for (int i = 0; i < 20; ++i)  // more than are listed pair by pair
    problem.bodies.push_back(
        body("far" + std::to_string(i), "sphere", 0.01, 2500, {1.0 + i, 0, 0}, {0, 0, 0}));
  Solver solver(problem);
  test::step(solver, 0.1);
  EXPECT_GT(solver.motions().velocity[0].x(), 0);
  EXPECT_EQ(solver.motions().velocity[5].norm(), 0);
}

}  // namespace
}  // namespace fpi::dem
