/// Flows that repeat themselves along x, y or both, with and without bodies that reach over periodic sides.
#include <gtest/gtest.h>

#include "fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;
constexpr std::array<bool, 2> along_x{true, false}, along_both{true, true};

Mesh torus(int n) { return make_rectangle(uniform_lines(0, 1, n), uniform_lines(0, 1, n), {}, along_both); }

TEST(Periodic, poiseuille_flow_driven_by_a_force_is_exact_to_round_off) {
  for (const int nx : {1, 2, 3, 6}) {
    auto s = settings(1.3, 0.7, {{"bottom", no_slip()}, {"top", no_slip()}});
    s.fluid.pressure_drop = {"5.6", "0"};
    NavierStokes solver(make_rectangle(uniform_lines(0, 2, nx), uniform_lines(0, 1, 5), {}, along_x), s);
    const Result result = solve_steady(solver);
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    const auto e = errors(
        solver, [](const Vec2& x) { return Vec2(4 * x.y() * (1 - x.y()), 0); },
        [](const Vec2& x) { return (Eigen::Matrix2d() << 0, 4 - 8 * x.y(), 0, 0).finished(); },
        [](const Vec2&) { return 0; });
    EXPECT_LT(e.velocity_l2, 1e-13) << nx;
    EXPECT_LT(e.velocity_h1, 1e-12) << nx;
    EXPECT_LT(e.pressure_l2, 1e-12) << nx;
    ASSERT_EQ(solver.boundary_curves().size(), 2u);  // walls only
    for (const BoundaryTraction& wall : solver.boundary_tractions()) {
      EXPECT_NEAR(wall.force.x(), 5.6, 1e-12);  // half of what drives two square metres
      EXPECT_NEAR(wall.force.y(), 0, 1e-12);
      for (const Vec2& t : wall.values) EXPECT_NEAR(t.x(), 2.8, 1e-11);
    }
  }
}

/// Errors of decaying Taylor–Green vortices that drift with a uniform flow [m/s], at the time `end`.
Errors vortices(int n, const Vec2& drift, double viscosity, double end, int steps) {
  const double decay = std::exp(-8 * pi * pi * viscosity * end);
  const auto phase = [=](const Vec2& x) { return Vec2(2 * pi * (x - end * drift)); };
  const auto u = [=](const Vec2& at) {
    const Vec2 x = phase(at);
    return Vec2(drift + decay * Vec2(-std::cos(x.x()) * std::sin(x.y()), std::sin(x.x()) * std::cos(x.y())));
  };
  const auto du = [=](const Vec2& at) {
    const Vec2 x = phase(at);
    const double a = std::sin(x.x()) * std::sin(x.y()), b = std::cos(x.x()) * std::cos(x.y());
    return (2 * pi * decay * (Eigen::Matrix2d() << a, -b, b, -a).finished()).eval();
  };
  const auto p = [=](const Vec2& at) {
    const Vec2 x = 2 * phase(at);
    return -(std::cos(x.x()) + std::cos(x.y())) / 4 * decay * decay;
  };
  auto s = settings(1, viscosity, {});
  s.fluid.initial_velocity = {fmt::format("{}-cos(2*pi*x)*sin(2*pi*y)", drift.x()),
                              fmt::format("{}+sin(2*pi*x)*cos(2*pi*y)", drift.y())};
  NavierStokes solver(torus(n), s);
  for (int k = 1; k <= steps; ++k) {
    EXPECT_TRUE(solver.advance({k * end / steps, end / steps, 0, {}}).newton.converged);
    solver.accept();
  }
  return errors(solver, u, du, p);
}

TEST(Periodic, taylor_green_vortices_in_a_torus_converge_with_orders_3_2_2) {
  std::vector<double> l2, h1, pressure;
  for (const int n : {8, 16, 32}) {
    const Errors e = vortices(n, Vec2::Zero(), 1e-3, 0.5, 10);
    l2.push_back(e.velocity_l2);
    h1.push_back(e.velocity_h1);
    pressure.push_back(e.pressure_l2);
  }
  std::cout << fmt::format(
      "vortices in a torus, 8/16/32 cells: velocity {:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f} {:.2f}\n",
      l2[0], l2[1], l2[2], order(l2), order(h1), order(pressure));
  EXPECT_GT(order(l2), 2.8);
  EXPECT_GT(order(h1), 1.9);
  EXPECT_GT(order(pressure), 1.9);
}

TEST(Periodic, vortices_that_leave_through_the_sides_come_back_with_order_2) {
  std::vector<double> l2;
  for (const int n : {8, 16}) l2.push_back(vortices(n, {1, 0.5}, 0.01, 1.5, 3 * n).velocity_l2);
  std::cout << fmt::format("drifting vortices, 8/16 cells: {:.2e} {:.2e}, order {:.2f}\n", l2[0], l2[1],
                           order(l2));
  EXPECT_GT(order(l2), 1.8);
}

/// Force [N/m] and torque [N] on a disc, and the velocity a little beside it.
Eigen::Vector<double, 5> answer(NavierStokes& solver, const Vec2& centre) {
  Interface disc = circle(0, centre, 0.2, solver.arc_length(Disc{centre, 0.2}));
  disc.rigid.spin = 0.5;
  const Result result = solve_steady(solver, {disc});
  EXPECT_TRUE(result.newton.converged) << result.newton.reason;
  const auto& [body, lambda, force, torque, arc_length] = result.tractions.at(0);
  const Vec2 beside = solver.at(centre + Vec2(0.27, 0.31))->first;
  return {force.x(), force.y(), torque, beside.x(), beside.y()};
}

TEST(Periodic, a_body_across_a_side_feels_what_it_feels_in_the_middle) {
  const auto answer_at = [](const Vec2& centre) {
    auto s = settings(1, 0.05, {{"left", velocity("1+0.3*sin(2*pi*y)^2", "0")}, {"right", open()}});
    s.fluid.newton.relative_tolerance = 1e-12;
    NavierStokes solver(make_rectangle(uniform_lines(0, 2, 20), uniform_lines(0, 1, 12), {}, {false, true}),
                        s);
    return answer(solver, centre);
  };
  const auto in_the_middle = answer_at({0.62, 0.523});
  for (const double y : {1.023, 0.023, -0.477, 100.023})
    EXPECT_LT((answer_at({0.62, y}) - in_the_middle).norm(), 1e-10 * in_the_middle.norm()) << y;
}

}  // namespace
}  // namespace fpi::fluid
