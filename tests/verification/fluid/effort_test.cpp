/// What a scene does not need is not done: factorisations, analyses and corrections are counted.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;

Settings channel(double viscosity, const std::string& inflow = "4*y*(1-y)") {
  return settings(
      1, viscosity,
      {{"left", velocity(inflow, "0")}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}});
}

void march(NavierStokes& solver, double time_step, int first, int last,
           const std::vector<Interface>& bodies = {}) {
  for (int step = first; step <= last; ++step) {
    const Result result = solver.advance({time_step * step, time_step, 0, bodies});
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    solver.accept();
  }
}

double counted(NavierStokes& solver, const char* what) { return solver.monitor.timers.counts[what]; }

TEST(Effort, a_hundred_steps_of_stokes_flow_take_one_factorisation_after_the_start) {
  auto s = channel(1, "4*y*(1-y)*sin(t)");
  s.fluid.convection = false;
  NavierStokes solver(square(12), s);
  const std::vector<Interface> disc{circle(0, {0.4, 0.5}, 0.15, 1.0 / 12)};
  march(solver, 0.01, 1, 3, disc);
  EXPECT_EQ(counted(solver, "factorisations"), 3);  // looking for an acceleration, the steps, looking again
  march(solver, 0.01, 4, 100, disc);
  EXPECT_EQ(counted(solver, "factorisations"), 3);
  EXPECT_EQ(counted(solver, "analyses"), 1);
  EXPECT_EQ(counted(solver, "newton_iterations"), 2 + 2 + 2 + 100);  // two accelerations, two more halves
}

TEST(Effort, a_sudden_start_costs_its_damped_steps_and_a_second_acceleration) {
  auto s = channel(1);
  s.fluid.convection = false;
  NavierStokes solver(square(12), s);
  march(solver, 0.01, 1, 3);
  EXPECT_EQ(counted(solver, "factorisations"), 3);  // looking for an acceleration, the steps, looking again
  march(solver, 0.01, 4, 50);
  EXPECT_EQ(counted(solver, "factorisations"), 3);
}

TEST(Effort, a_flow_that_changes_slowly_keeps_its_factor_for_many_steps) {
  NavierStokes solver(square(12), channel(0.01, "4*y*(1-y)*(1+0.3*sin(2*t))"));
  const std::vector<Interface> disc{circle(0, {0.4, 0.5}, 0.15, 1.0 / 12)};
  march(solver, 0.02, 1, 60, disc);
  EXPECT_LE(counted(solver, "factorisations"), 12);
  EXPECT_EQ(counted(solver, "analyses"), 1);
  EXPECT_LE(counted(solver, "newton_iterations"), 60 * 8);
}

TEST(Effort, a_guess_that_meets_the_tolerance_takes_one_correction_a_step) {
  auto s = channel(0.1);
  s.fluid.initial_velocity = {"4*y*(1-y)", "0"};
  s.fluid.boundaries["right"] = velocity("4*y*(1-y)", "0");
  NavierStokes solver(square(8), s);
  march(solver, 0.05, 1, 2);
  const double before = counted(solver, "newton_iterations");
  march(solver, 0.05, 3, 12);
  EXPECT_EQ(counted(solver, "newton_iterations") - before, 10);
}

TEST(Effort, creeping_flow_is_found_with_the_factor_of_stokes_flow) {
  NavierStokes solver(square(12), channel(100));
  ASSERT_TRUE(solve_steady(solver).newton.converged);
  EXPECT_EQ(counted(solver, "factorisations"), 1);
}

/// Forces on one of two discs that goes through a channel beside the other, step by step.
std::vector<Vec2> forces_on_a_moving_disc(NavierStokes& solver, bool keeps_factors) {
  std::vector<Vec2> forces;
  for (int step = 1; step <= 20; ++step) {
    Interface moving = circle(0, {0.3 + 0.01 * step, 0.5 + 0.004 * step}, 0.12, 1.0 / 24);
    moving.rigid.translation = {1, 0.4};
    const Result result =
        solver.advance({0.01 * step, 0.01, 0, {moving, circle(1, {0.75, 0.2}, 0.1, 1.0 / 24)}});
    EXPECT_TRUE(result.newton.converged) << result.newton.reason;
    solver.accept();
    if (!keeps_factors) solver.drop_caches();
    forces.push_back(result.tractions[0].force);
  }
  return forces;
}

TEST(Effort, a_disc_that_moves_through_a_flow_keeps_the_factor_of_where_it_was) {
  for (const bool convection : {true, false}) {
    auto s = channel(0.02);
    s.bodies_move = true;
    s.fluid.convection = convection;
    s.fluid.newton.relative_tolerance = 1e-9;
    NavierStokes keeping(square(24), s), dropping(square(24), s);
    const auto kept = forces_on_a_moving_disc(keeping, true);
    const auto dropped = forces_on_a_moving_disc(dropping, false);
    for (std::size_t k = 0; k < kept.size(); ++k)
      EXPECT_LT((kept[k] - dropped[k]).norm(), 1e-6 * dropped[k].norm()) << k;
    EXPECT_GE(counted(dropping, "factorisations"), 20);
    EXPECT_LE(counted(keeping, "factorisations"), 5);
    EXPECT_LE(counted(keeping, "newton_iterations"), 2.5 * counted(dropping, "newton_iterations") + 20 * 8);
  }
}

TEST(Effort, a_linear_problem_keeps_the_factor_that_a_resumed_run_makes_again) {
  auto s = channel(0.1);
  s.fluid.convection = false;
  NavierStokes solver(square(8), s), resumed(square(8), s);
  march(solver, 0.05, 1, 10);
  const double before = counted(solver, "factorisations");
  solver.drop_caches();
  resumed.set_state(solver.state());
  march(solver, 0.05, 11, 20);
  march(resumed, 0.05, 11, 20);
  EXPECT_EQ(counted(solver, "factorisations"), before);
  EXPECT_EQ(counted(resumed, "factorisations"), 1);
  EXPECT_EQ(solver.state().u, resumed.state().u) << "to the bit";
  EXPECT_EQ(solver.state().p, resumed.state().p);
}

}  // namespace
}  // namespace fpi::fluid
