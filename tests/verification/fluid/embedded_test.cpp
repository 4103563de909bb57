/// Bodies embedded in the non-matching mesh, against analytic and reference values.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

/// Taylor–Couette flow: an inner disc r1 = 1 turns with Ω = 1 about (0.013, 0.027), the outer circle r2 = 2
/// is given on the sides of a square by the exact solution. Torque per length on the disc −4πμΩ r1² r2²/(r2²
/// − r1²).
double couette_torque(int elements_per_diameter) {
  const double r1 = 1, r2 = 2, omega = 1, mu = 0.3;
  const double b = omega * r1 * r1 * r2 * r2 / (r2 * r2 - r1 * r1),
               a = -omega * r1 * r1 / (r2 * r2 - r1 * r1);
  const std::string x = "(x-0.013)", y = "(y-0.027)";
  const std::string factor = fmt::format("({:.17g}+{:.17g}/({}^2+{}^2))", a, b, x, y);
  const auto given = velocity("-" + y + "*" + factor, x + "*" + factor);
  auto s = settings(1, mu, {{"left", given}, {"right", given}, {"bottom", given}, {"top", given}});
  const int n = elements_per_diameter * 3 / 2;
  NavierStokes solver(square(n, -1.5, 1.5), s);
  Interface disc = circle(0, {0.013, 0.027}, r1, solver.arc_length(Disc{{0.013, 0.027}, r1}));
  disc.rigid.spin = omega;
  const Result result = solve_steady(solver, {disc});
  EXPECT_TRUE(result.newton.converged) << result.newton.reason;
  EXPECT_LT(result.tractions[0].force.norm() * r1, 1e-3 * std::abs(result.tractions[0].torque));
  return result.tractions[0].torque / (-4 * pi * mu * b) - 1;
}

TEST(Embedded, taylor_couette_torque_converges_with_order_3_or_better) {
  std::vector<double> e;
  for (const int n : {8, 16, 32}) e.push_back(std::abs(couette_torque(n)));
  std::cout << fmt::format("Taylor-Couette torque, D/h 8/16/32: {:.2e} {:.2e} {:.2e}\n", e[0], e[1], e[2]);
  EXPECT_LT(e[0], 1e-3);
  EXPECT_LT(e[1], 1e-4);
  EXPECT_GT(std::log2(e[0] / e[2]) / 2, 3);
}

/// DFG 2D-1 (Schäfer & Turek; paper section 5.1, eqs. 24–26) with the cylinder embedded.
TEST(Embedded, dfg_2d_1_drag_and_lift_at_16_elements_a_diameter) {
  const Settings s = dfg_2d_1();
  const double h = 0.1 / 16;
  NavierStokes solver(make_rectangle(graded_lines(0, 2.2, 0.13, 0.3, h, 1.12, 0.06),
                                     graded_lines(0, 0.41, 0.12, 0.28, h, 1.1, 0.02)),
                      s);
  const Result result =
      solve_steady(solver, {circle(0, {0.2, 0.2}, 0.05, solver.arc_length(Disc{{0.2, 0.2}, 0.05}))});
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const double scale = 2 / (0.2 * 0.2 * 0.1);
  const double cd = scale * result.tractions[0].force.x(), cl = scale * result.tractions[0].force.y();
  const double dp = solver.at({0.15, 0.2})->second - solver.at({0.25, 0.2})->second;
  std::cout << fmt::format(
      "DFG 2D-1 embedded, D/h 16, {} unknowns, {} Newton steps: cd {:.6f} ({:.1e}), cl {:.6f} "
      "({:.1e}), dp {:.6f} ({:.1e})\n",
      solver.n_unknowns(), result.newton.iterations, cd, cd / 5.57953523384 - 1, cl, cl - 0.010618948146, dp,
      dp / 0.11752016697 - 1);
  EXPECT_NEAR(cd, 5.57953523384, 1e-3 * 5.58);
  EXPECT_NEAR(cl, 0.010618948146, 5e-4);
  EXPECT_NEAR(dp, 0.11752016697, 0.02 * 0.1175);
}

/// The same case twice, and once more after a detour: all bitwise equal.
TEST(Embedded, advance_is_pure_and_restore_is_bitwise) {
  auto s = settings(1, 0.01,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.bodies_move = true;
  NavierStokes solver(square(16), s);
  const auto disc_at = [&](double t, double v) {
    Interface disc = circle(0, {0.5 + 0.1 * t, 0.5}, 0.2, 1.0 / 16);
    disc.rigid.translation = {v, 0.2};
    disc.rigid.spin = 1;
    return disc;
  };
  const auto run = [&] {
    std::vector<double> out;
    for (unsigned k = 0; k < 3; ++k) {
      const Result r = solver.advance(
          {solver.state().time + 0.05, 0.05, k, {disc_at(solver.state().time, 0.1 + 0.01 * k)}});
      EXPECT_TRUE(r.newton.converged);
      for (const BodyTraction& t : r.tractions)
        for (const Vec2& l : t.lambda) out.insert(out.end(), {l.x(), l.y()});
    }
    return out;
  };
  for (int step = 0; step < 3; ++step) {
    const auto first = run();
    solver.restore();
    EXPECT_EQ(run(), first);
    EXPECT_TRUE(
        solver.advance({solver.state().time + 0.013, 0.013, 0, {disc_at(0.3, 0.4)}}).newton.converged);
    solver.restore();
    EXPECT_EQ(run(), first);
    solver.accept();
  }
}

TEST(Embedded, a_restored_first_step_leaves_nothing_behind) {
  auto s = settings(
      1, 0.1,
      {{"left", velocity("t*y*(1-y)", "0")}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}});
  const std::vector<Interface> disc{circle(0, {0.4, 0.5}, 0.15, 1.0 / 12)};
  NavierStokes fresh(square(12), s), restored(square(12), s);
  const Result detour = restored.advance({0.2, 0.2, 0, disc});
  ASSERT_TRUE(detour.newton.converged) << detour.newton.reason;
  restored.restore();
  const Result a = fresh.advance({0.05, 0.05, 0, disc}), b = restored.advance({0.05, 0.05, 0, disc});
  EXPECT_EQ(a.tractions[0].force, b.tractions[0].force);
  EXPECT_EQ(a.tractions[0].lambda, b.tractions[0].lambda);
}

TEST(Embedded, a_linear_flow_trusts_no_factor_of_another_time_scheme) {
  auto s = settings(1, 0.1,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.convection = false;
  s.bodies_move = true;  // backward Euler first, then BDF2
  Interface disc = circle(0, {0.52, 0.47}, 0.2, 1.0 / 12);
  disc.rigid.spin = 1;
  NavierStokes solver(square(12), s);
  for (int step = 1; step <= 3; ++step) {
    const Result once = solver.advance({0.01 * step, 0.01, 0, {disc}});
    const Result twice = solver.advance({0.01 * step, 0.01, 1, {disc}});
    EXPECT_LT((once.tractions[0].force - twice.tractions[0].force).norm(), 1e-10) << step;
    solver.accept();
  }
}

TEST(Embedded, interfaces_that_make_no_sense_are_refused_with_the_body) {
  auto s = settings(1, 0.1,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  NavierStokes solver(square(8), s);
  const Interface good = circle(3, {0.5, 0.5}, 0.2, 1.0 / 8);
  const auto refused = [&](std::vector<Interface> bodies) {
    try {
      solver.advance({0.1, 0.1, 0, std::move(bodies)});
    } catch (const Error& e) {
      return std::string(e.what()).find('3') != std::string::npos;
    }
    return false;
  };
  Interface gap = good, twice = good, huge = good, again = good;
  gap.start.pop_back();
  gap.end.pop_back();
  twice.start.insert(twice.start.end(), good.start.begin(), good.start.end());
  twice.end.insert(twice.end.end(), good.end.begin(), good.end.end());
  huge.rigid.translation = {1e155, 0};
  again.body = 4;
  EXPECT_TRUE(refused({gap}));
  EXPECT_TRUE(refused({twice}));
  EXPECT_TRUE(refused({huge}));
  EXPECT_TRUE(refused({good, again}));
  EXPECT_TRUE(refused({good, good}));
  EXPECT_FALSE(refused({good}));
}

TEST(Embedded, no_sub_iteration_goes_on_from_one_that_did_not_converge) {
  auto s = settings(
      1, 1e-6, {{"left", velocity("1", "0")}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.newton.max_iterations = 1;
  NavierStokes solver(square(6), s);
  Request request{0.1, 0.1, 0, {}};
  ASSERT_FALSE(solver.advance(request).newton.converged);
  request.sub_iteration = 1;
  EXPECT_THROW(solver.advance(request), Error);
}

TEST(Embedded, a_body_that_cuts_a_curved_triangle_is_refused_with_the_place) {
  Mesh mesh = square(6);
  const Index curved = mesh.boundary.front().edge;
  mesh.middles[curved] += Vec2(-0.01, 0);  // on the left side
  NavierStokes solver(
      mesh,
      settings(1, 1, {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}}));
  const Vec2 place = mesh.middles[curved];
  try {
    solver.advance({0.1, 0.1, 0, {circle(0, place, 0.12, 1.0 / 6)}});
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("cuts the curved triangle at ("), std::string::npos) << e.what();
  }
}

TEST(Embedded, a_moving_disc_keeps_its_force_quiet_and_finite) {
  auto s = settings(1, 0.02,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.bodies_move = true;
  NavierStokes solver(square(24), s);
  const double dt = 0.01, speed = 0.8;  // a fifth of h a step
  Vec2 centre(0.3, 0.5);
  std::vector<double> force;
  for (int step = 1; step <= 40; ++step) {
    centre.x() += speed * dt;
    Interface disc = circle(0, centre, 0.12, 1.0 / 24);
    disc.rigid.translation = {speed, 0};
    const Result r = solver.advance({step * dt, dt, 0, {disc}});
    ASSERT_TRUE(r.newton.converged) << step << ": " << r.newton.reason;
    solver.accept();
    force.push_back(r.tractions[0].force.x());
  }
  double noise = 0;
  for (std::size_t k = 21; k + 1 < force.size(); ++k)
    noise = std::max(noise, std::abs(force[k + 1] - 2 * force[k] + force[k - 1]) / 4);
  std::cout << fmt::format("moving disc: force {:.5f}, noise {:.1e} of it\n", force.back(),
                           noise / std::abs(force.back()));
  EXPECT_LT(force.back(), 0);
  EXPECT_LT(noise, 0.01 * std::abs(force.back()));
}

}  // namespace
}  // namespace fpi::fluid
