/// The implicit trapezoidal rule: order two, energies beside those of velocity Verlet, momentum, and what it
/// says where its iteration finds no end.
#include <gtest/gtest.h>

#include <iostream>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::step;

/// A ball that a linear spring carries: it swings about its place of rest by a tenth of the overlap there.
struct Swing {
  Problem problem;
  double omega, rest, amplitude;

  explicit Swing(const std::string& scheme) {
    scene::Material m = material(0, 0.3);
    m.normal_stiffness = 1e4;
    problem = test::on_floor(m, body("ball", "sphere", 0.01, 2500, {0, 0, 0}, {0, 0, 0}));
    problem.dem.contact = "linear";
    problem.dem.scheme = scheme;
    const double mass = 2500 * problem.bodies[0].volume(0.01, 1);
    omega = std::sqrt(1e4 / mass);
    rest = 0.01 - 9.81 * mass / 1e4;
    amplitude = 0.1 * (0.01 - rest);
    problem.bodies[0].position[1] = rest + amplitude;
  }
};

/// Over ten periods of `n` sub-steps each: how far the ball is from its place, over the amplitude; and by how
/// much its energy of swinging has changed.
std::pair<double, double> errors(const std::string& scheme, int n) {
  Swing swing(scheme);
  const double end = 10 * 2 * std::numbers::pi / swing.omega;
  swing.problem.dem.largest_sub_step = end / (10 * n) * (1 + 1e-9);
  swing.problem.dem.steps_per_contact = 10;
  Solver solver(swing.problem);
  const double start = test::energy(solver);
  EXPECT_EQ(step(solver, end).sub_steps, static_cast<std::uint64_t>(10 * n));
  const double energy = 0.5 * 1e4 * swing.amplitude * swing.amplitude;
  return {std::abs(solver.motions().position[0].y() - swing.rest - swing.amplitude) / swing.amplitude,
          std::abs(test::energy(solver) - start) / energy};
}

TEST(Trapezoidal, swings_of_a_ball_on_a_spring_have_second_order_and_keep_their_energy) {
  const auto [coarse, lost] = errors("trapezoidal", 100);
  const auto [fine, lost_less] = errors("trapezoidal", 200);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.1)
      << "at an extremum the place is off by the square of the phase";
  EXPECT_LT(lost + lost_less, 2e-9);
  // Theory: the phase is off by (ω Δt)²/12 of itself.
  const double phase = 20 * std::numbers::pi * std::pow(2 * std::numbers::pi / 100, 2) / 12;
  EXPECT_NEAR(coarse / (1 - std::cos(phase)), 1, 0.01);
  std::cout << fmt::format("energy after ten swings of 100 sub-steps: trapezoidal {:.1e}, Verlet {:.1e}\n",
                           lost, errors("verlet", 100).second);
}

TEST(Trapezoidal, an_impact_without_damping_keeps_its_energy_to_second_order) {
  const auto error = [](const std::string& scheme, double steps) {
    Problem problem =
        test::on_floor(material(1e8, 0.3), body("b", "sphere", 0.01, 2500, {0, 0.0101, 0}, {0, -1, 0}));
    problem.gravity.setZero();
    problem.dem.scheme = scheme;
    problem.dem.steps_per_contact = steps;
    Solver solver(problem);
    step(solver, 0.01);
    return std::abs(solver.motions().velocity[0].y() - 1);
  };
  for (const double steps : {25.0, 50.0, 100.0, 200.0})
    std::cout << fmt::format("t_c/{}: speed after an impact off by {:.1e} (trapezoidal), {:.1e} (Verlet)\n",
                             steps, error("trapezoidal", steps), error("verlet", steps));
  EXPECT_LT(error("trapezoidal", 50), 1e-3);
  EXPECT_GT(std::log2(error("trapezoidal", 50) / error("trapezoidal", 200)) / 2, 1.5);
}

TEST(Trapezoidal, sliding_ends_in_rolling_at_the_speed_of_theory_and_the_account_of_energies_closes) {
  Problem problem = test::on_floor(material(1e7, 0.3, 0.6, 0.3),
                                   body("b", "sphere", 0.01, 2500, {0, 0.01, 0}, {0.5, 0, 0}));
  problem.dem.scheme = "trapezoidal";
  problem.dem.energy = true;
  Solver solver(problem);
  const auto closed = [&] {
    const auto e = solver.energies().value();
    double sum = 0;
    for (std::size_t k = 0; k < e.size(); ++k) sum += k < 7 ? e[k] : -e[k];
    return sum;
  };
  const double start = closed();
  for (int i = 0; i < 40; ++i) step(solver, 0.01);
  EXPECT_NEAR(solver.motions().velocity[0].x() / (0.5 * 5 / 7), 1, 1e-6);
  EXPECT_NEAR(closed(), start, 1e-12 * solver.energies().value()[0]);
}

TEST(Trapezoidal, a_box_of_discs_goes_the_way_of_verlet_and_comes_back_bitwise) {
  Problem problem = test::box_of_discs();
  Solver verlet(problem);
  problem.dem.scheme = "trapezoidal";
  Solver solver(problem);
  for (int i = 0; i < 10; ++i) {
    step(solver, 5e-3);
    step(verlet, 5e-3);
  }
  for (std::size_t i = 0; i < 25; ++i)
    EXPECT_LT((solver.motions().position[i] - verlet.motions().position[i]).norm(), 2e-4) << i;
  Solver resumed(problem);
  resumed.resume(solver.checkpoint());
  solver.advance(1e-2, {});
  solver.restore();
  step(solver, 5e-3);
  step(resumed, 5e-3);
  EXPECT_TRUE(test::bitwise_equal(solver.motions(), resumed.motions()));
}

TEST(Trapezoidal, a_sub_step_that_cannot_be_solved_says_what_to_do) {
  Problem problem = test::on_floor(material(1e7, 0.3, 0.12, 0.9),
                                   body("b", "sphere", 0.01, 2500, {0, 0.0101, 0}, {0.1, -1, 0}));
  problem.dem.scheme = "trapezoidal";
  problem.dem.steps_per_contact = 10;
  const Advanced outcome = Solver(problem).advance(0.01, {});
  EXPECT_FALSE(outcome.converged);
  EXPECT_NE(outcome.reason.find("raise dem.steps_per_contact"), std::string::npos) << outcome.reason;
  problem.dem.steps_per_contact = 50;
  EXPECT_EQ(Solver(problem).advance(0.01, {}).reason, "");
}

}  // namespace
}  // namespace fpi::dem
