/// Flows that repeat themselves along x, y or both, with and without bodies that reach over periodic sides.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

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
  const BodyTraction& on_disc = result.tractions.at(0);
  const Vec2 beside = solver.at(centre + Vec2(0.27, 0.31))->first;
  return {on_disc.force.x(), on_disc.force.y(), on_disc.torque, beside.x(), beside.y()};
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

/// Sangani & Acrivos (1982): cylinders in a square array, Stokes flow; F/(μU) by the solid fraction.
double drag_of_square_array(double fraction, int n, const Vec2& centre) {
  auto s = settings(1, 1, {});
  s.fluid.convection = false;
  s.fluid.pressure_drop = {"1", "0"};
  NavierStokes solver(torus(n), s);
  const Disc disc{centre, std::sqrt(fraction / pi)};
  const Result result = solve_steady(solver, {circle(0, centre, disc.radius, solver.arc_length(disc))});
  EXPECT_TRUE(result.newton.converged) << result.newton.reason;
  EXPECT_NEAR((result.tractions[0].force - Vec2(1, 0)).norm(), 0, 1e-10);  // all of the force on the cell
  const Vec2 velocity = solver.superficial_velocity();
  std::cout << fmt::format("square array {}, D/h {:.1f}, {} unknowns: {:.8g}\n", fraction,
                           2 * n * disc.radius, solver.n_unknowns(), 1 / velocity.x());
  return 1 / velocity.x();
}

TEST(Periodic, drag_of_square_arrays_is_within_a_thousandth_of_sangani_and_acrivos) {
  struct Case {
    double fraction, expected;
    int cells;
  };
  for (const auto& [fraction, expected, n] :
       {Case{0.05, 15.56, 32}, {0.2, 51.53, 16}, {0.4, 217.89, 16}, {0.6, 1763, 32}})
    EXPECT_NEAR(drag_of_square_array(fraction, n, {0.513, 0.527}), expected, 1e-3 * expected);
  const double across_a_corner = drag_of_square_array(0.2, 16, {0.013, 0.027});
  EXPECT_NEAR(across_a_corner, drag_of_square_array(0.2, 16, {0.513, 0.527}), 1e-5 * across_a_corner);
}

/// A disc that is carried along a channel, twice around.
TEST(Periodic, a_body_that_drifts_through_the_side_feels_the_same_each_time) {
  constexpr int n = 8, steps_per_period = 4 * n;
  const double step = 1.0 / steps_per_period;
  auto s = settings(1, 4, {{"bottom", no_slip()}, {"top", no_slip()}});
  s.bodies_move = true;
  s.fluid.newmark_gamma = 1;  // forgets its start
  s.fluid.newton.relative_tolerance = 1e-11;
  NavierStokes solver(make_rectangle(uniform_lines(0, 1, n), uniform_lines(0, 1, n), {}, along_x), s);
  std::vector<Vec2> force;
  for (int k = 1; k <= 2 * steps_per_period; ++k) {
    Interface disc = circle(0, {0.313 + k * step, 0.427}, 0.2, 1.0 / n);
    disc.rigid.translation = {1, 0};
    const Result result = solver.advance({k * step, step, 0, {disc}});
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    force.push_back(result.tractions[0].force);
    solver.accept();
  }
  for (int k = steps_per_period / 2; k < steps_per_period; ++k)
    EXPECT_NEAR((force[k + steps_per_period] - force[k]).norm(), 0, 1e-8 * force[k].norm()) << "step " << k;
}

/// Stokes flow sheared between walls: a small disc in the middle that feels no torque turns with half the
/// rate. The mesh is refined around it, also where it lies across the periodic side.
TEST(Periodic, a_small_disc_in_shear_flow_turns_with_half_the_rate) {
  const auto torque_free_spin = [](double x) {
    auto s = settings(1, 1, {{"bottom", velocity("-0.5", "0")}, {"top", velocity("0.5", "0")}});
    s.fluid.convection = false;
    std::vector<scene::Refinement> around(2);  // the disc and its image
    for (int image : {0, 1}) {
      around[image].size = 1.0 / 64;
      around[image].centre = {x + image, 0.5};
      around[image].radius = 0.06;
    }
    const auto lines = uniform_lines(0, 1, 8);
    NavierStokes solver(make_rectangle(lines, lines, around, along_x), s);
    std::array<double, 2> torque{};
    for (int spin : {0, 1}) {
      Interface disc = circle(0, {x, 0.5}, 0.06, solver.arc_length(Disc{{x, 0.5}, 0.06}));
      disc.rigid.spin = -spin;
      const BodyTraction body = solve_steady(solver, {disc}).tractions.at(0);
      EXPECT_NEAR(body.force.norm(), 0, 1e-3);
      torque[spin] = body.torque;
    }
    return torque[0] / (torque[0] - torque[1]);
  };
  const double in_the_middle = torque_free_spin(0.5), across_the_side = torque_free_spin(0);
  std::cout << fmt::format("torque-free spin in shear of rate 1: {:.5f}, across the side {:.5f}\n",
                           in_the_middle, across_the_side);
  EXPECT_NEAR(in_the_middle, 0.5, 0.005);
  EXPECT_NEAR(across_the_side, in_the_middle, 1e-6);
}

TEST(Periodic, a_steady_flow_that_nothing_holds_is_refused) {
  auto s = settings(1, 1, {{"bottom", slip()}, {"top", slip()}});
  NavierStokes between_slip_walls(make_rectangle(uniform_lines(0, 1, 4), uniform_lines(0, 1, 4), {}, along_x),
                                  s);
  NavierStokes in_a_torus(torus(4), settings(1, 1, {}));
  for (NavierStokes* solver : {&between_slip_walls, &in_a_torus}) try {
      solve_steady(*solver);
      ADD_FAILURE();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("nothing holds the fluid along ("), std::string::npos) << e.what();
    }
  EXPECT_TRUE(solve_steady(in_a_torus, {circle(0, {0.4, 0.4}, 0.2, 0.2)}).newton.converged);
}

TEST(Periodic, a_force_that_nothing_holds_makes_the_fluid_ever_faster) {
  auto s = settings(2, 1, {});
  s.fluid.pressure_drop = {"1", "-3"};
  NavierStokes solver(torus(4), s);
  for (int k = 1; k <= 4; ++k) {
    ASSERT_TRUE(solver.advance({0.25 * k, 0.25, 0, {}}).newton.converged);
    solver.accept();
    EXPECT_NEAR((solver.superficial_velocity() - 0.25 * k / 2 * Vec2(1, -3)).norm(), 0, 1e-6);
  }
}

}  // namespace
}  // namespace fpi::fluid
