/// The way to a steady flow: damping, continuation in the Reynolds number, and the reason where there is
/// none.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;

Settings cavity(double reynolds) {
  return settings(
      1, 1 / reynolds,
      {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", velocity("1", "0")}});
}

/// Lowest velocity_x on the vertical middle line, at nodes and between.
double lowest_on_middle_line(const NavierStokes& solver) {
  double lowest = 0;
  for (int i = 1; i < 1000; ++i) lowest = std::min(lowest, solver.at({0.5, i / 1000.0})->first.x());
  return lowest;
}

Mesh graded_square(int n) {
  std::vector<double> lines;
  for (int i = 0; i <= n; ++i) lines.push_back(0.5 - 0.5 * std::cos(std::numbers::pi * i / n));
  return make_rectangle(lines, lines);
}

TEST(Steady, cavity_at_reynolds_1000_is_found_from_stokes_flow) {
  NavierStokes solver(graded_square(32), cavity(1000));
  const Result result = solve_steady(solver);
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const double u_min = -0.3885698;  // Botella and Peyret 1998
  std::cout << fmt::format("cavity Re 1000, {} unknowns: u_min {:.6f}, {} factorisations, {} corrections\n",
                           solver.n_unknowns(), lowest_on_middle_line(solver),
                           solver.monitor.timers.counts["factorisations"], result.newton.iterations);
  EXPECT_NEAR(lowest_on_middle_line(solver), u_min, 5e-4);
}

TEST(Steady, what_newton_does_not_reach_is_reached_by_continuation) {
  auto s = cavity(1000);
  NavierStokes direct(graded_square(16), s);
  ASSERT_TRUE(solve_steady(direct).newton.converged);
  EXPECT_EQ(direct.monitor.timers.counts["continuation_retreats"], 0);
  s.fluid.newton.max_iterations = 14;
  NavierStokes by_parts(graded_square(16), s);
  const Result result = solve_steady(by_parts);
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  EXPECT_GT(by_parts.monitor.timers.counts["continuation_retreats"], 0);
  EXPECT_LT((by_parts.state().u - direct.state().u).norm(), 1e-6 * direct.state().u.norm());
}

TEST(Steady, a_flow_that_is_not_found_says_how_far_it_came_and_where_it_fails) {
  auto s = cavity(1e6);
  s.fluid.newton.max_iterations = 5;
  NavierStokes solver(square(4), s);
  const Result result = solve_steady(solver);
  ASSERT_FALSE(result.newton.converged);
  for (const char* word : {"no steady flow was found beyond", "of the Reynolds number", "of the velocity",
                           "the largest residual is", " m. Take a finer mesh"})
    EXPECT_NE(result.newton.reason.find(word), std::string::npos) << word << " in: " << result.newton.reason;
}

}  // namespace
}  // namespace fpi::fluid
