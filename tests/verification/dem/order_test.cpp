/// Orders in time of the integrators: error of an impact's duration against the sub-step.
#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;

/// Two equal spheres head-on, undamped, from a gap that is a share of the way in a contact time.
Problem impact(double steps_per_contact, double gap_share) {
  Problem problem;
  problem.materials = {material(1e9, 0.3)};
  problem.dem.steps_per_contact = steps_per_contact;
  const double mass = 2500 * 4.0 / 3 * std::numbers::pi * 1e-6;
  const double t_c =
      contact_time(0.5 * mass, 0.005, combine(problem.materials[0], problem.materials[0]).normal, 2);
  const double x = 0.01 + gap_share * t_c;
  problem.bodies = {body("left", "sphere", 0.01, 2500, {-x, 0, 0}, {1, 0, 0}),
                    body("right", "sphere", 0.01, 2500, {x, 0, 0}, {-1, 0, 0})};
  return problem;
}

/// Of an impact within one step: its duration by where the spheres are after it, and its speed; both over
/// what they should be, minus one.
struct Errors {
  double duration, speed;
};
Errors errors(double steps_per_contact, double gap_share) {
  const Problem problem = impact(steps_per_contact, gap_share);
  Solver solver(problem);
  const Motions& m = solver.motions();
  const auto gap = [&] { return m.position[1].x() - m.position[0].x() - 0.02; };
  const double before = gap(), t_c = 0.5 * before / gap_share;
  test::step(solver, 2 * t_c);
  const double speed = m.velocity[1].x() - m.velocity[0].x();
  return {(2 * t_c - before / 2 - gap() / speed) / t_c - 1, 0.5 * speed - 1};
}

/// The worst of several phases.
Errors worst(double steps_per_contact) {
  Errors most{0, 0};
  for (const double share : {.11, .23, .37, .41, .53}) {
    const Errors now = errors(steps_per_contact, share);
    most = {std::max(most.duration, std::abs(now.duration)), std::max(most.speed, std::abs(now.speed))};
  }
  return most;
}

TEST(Order, verlet_with_corrected_forces_has_impacts_of_fourth_order) {
  const Errors coarse = worst(25), fine = worst(50);
  EXPECT_LT(fine.duration, 6e-6);
  EXPECT_LT(fine.speed, 4e-7);
  EXPECT_GT(std::log2(coarse.duration / fine.duration), 3.5);
  EXPECT_GT(std::log2(coarse.speed / fine.speed), 4.5);
}

}  // namespace
}  // namespace fpi::dem
