/// Orders of convergence in space and time, fitted, against manufactured and analytic solutions.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

/// Kovasznay's solution of the steady Navier–Stokes equations at Re = 40 (Kovasznay 1948).
struct Kovasznay {
  double nu = 1.0 / 40;
  double l = 1 / (2 * nu) - std::sqrt(1 / (4 * nu * nu) + 4 * pi * pi);
  Vec2 u(const Vec2& x) const {
    const double e = std::exp(l * x.x());
    return {1 - e * std::cos(2 * pi * x.y()), l / (2 * pi) * e * std::sin(2 * pi * x.y())};
  }
  Eigen::Matrix2d du(const Vec2& x) const {
    const double e = std::exp(l * x.x()), s = std::sin(2 * pi * x.y()), c = std::cos(2 * pi * x.y());
    return (Eigen::Matrix2d() << -l * e * c, 2 * pi * e * s, l * l / (2 * pi) * e * s, l * e * c).finished();
  }
  double p(const Vec2& x) const { return -0.5 * std::exp(2 * l * x.x()); }
};

TEST(Convergence, steady_orders_are_3_and_2_for_velocity_and_2_for_pressure) {
  const Kovasznay k;
  const std::string l = fmt::format("({:.17g})", k.l);
  const auto given = velocity("1-exp(" + l + "*x)*cos(2*pi*y)", l + "/(2*pi)*exp(" + l + "*x)*sin(2*pi*y)");
  std::vector<double> l2, h1, p;
  for (const int n : {8, 16, 32}) {
    NavierStokes solver(
        make_rectangle(uniform_lines(-0.5, 0.5, n), uniform_lines(-0.5, 0.5, n)),
        settings(1, k.nu, {{"left", given}, {"right", given}, {"bottom", given}, {"top", given}}));
    const Result result = solve_steady(solver);
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    const Errors e = errors(
        solver, [&](const Vec2& x) { return k.u(x); }, [&](const Vec2& x) { return k.du(x); },
        [&](const Vec2& x) { return k.p(x); });
    l2.push_back(e.velocity_l2);
    h1.push_back(e.velocity_h1);
    p.push_back(e.pressure_l2);
  }
  RecordProperty("velocity_l2", fmt::format("{:.3e} order {:.2f}", l2.back(), order(l2)));
  std::cout << fmt::format(
      "Kovasznay: u L2 {:.3e} order {:.2f}, H1 {:.3e} order {:.2f}, p L2 {:.3e} order {:.2f}\n", l2.back(),
      order(l2), h1.back(), order(h1), p.back(), order(p));
  EXPECT_GT(order(l2), 2.85);
  EXPECT_GT(order(h1), 1.9);
  EXPECT_GT(order(p), 1.9);
}

/// Manufactured: u = rot(ψ), ψ = sin²(πx) sin²(πy) g(t), p = cos(πx) sin(πy) g(t); the body force makes it a
/// solution. Errors in time are taken against the same mesh with a step eight times finer, so that space
/// cancels.
class InTime : public ::testing::Test {
 protected:
  static Settings manufactured(double gamma) {
    const double nu = 0.05;
    auto s = settings(1, nu,
                      {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
    const std::string g = "cos(3*t)", dg = "(-3*sin(3*t))";
    const std::string ux = "(pi*sin(pi*x)^2*sin(2*pi*y))", uy = "(-pi*sin(2*pi*x)*sin(pi*y)^2)";
    const std::string ux_x = "(pi^2*sin(2*pi*x)*sin(2*pi*y))", ux_y = "(2*pi^2*sin(pi*x)^2*cos(2*pi*y))";
    const std::string uy_x = "(-2*pi^2*cos(2*pi*x)*sin(pi*y)^2)", uy_y = "(-pi^2*sin(2*pi*x)*sin(2*pi*y))";
    const std::string lap_x = "(2*pi^3*cos(2*pi*x)*sin(2*pi*y)-4*pi^3*sin(pi*x)^2*sin(2*pi*y))";
    const std::string lap_y = "(4*pi^3*sin(2*pi*x)*sin(pi*y)^2-2*pi^3*sin(2*pi*x)*cos(2*pi*y))";
    const std::string p_x = "(-pi*sin(pi*x)*sin(pi*y))", p_y = "(pi*cos(pi*x)*cos(pi*y))";
    s.fluid.body_force = {ux + "*" + dg + "+" + g + "^2*(" + ux + "*" + ux_x + "+" + uy + "*" + ux_y +
                              ")-0.05*" + lap_x + "*" + g + "+" + p_x + "*" + g,
                          uy + "*" + dg + "+" + g + "^2*(" + ux + "*" + uy_x + "+" + uy + "*" + uy_y +
                              ")-0.05*" + lap_y + "*" + g + "+" + p_y + "*" + g};
    s.fluid.initial_velocity = {ux, uy};
    s.fluid.newmark_gamma = gamma;
    return s;
  }
  static State run(double gamma, int steps) {
    NavierStokes solver(square(6), manufactured(gamma));
    const double end = 0.8;
    for (int k = 1; k <= steps; ++k) {
      const Result result = solver.advance({end * k / steps, end / steps, 0, {}});
      EXPECT_TRUE(result.newton.converged) << result.newton.reason;
      solver.accept();
    }
    return solver.state();
  }
  static std::pair<double, double> orders(double gamma) {
    const State reference = run(gamma, 256);
    std::vector<double> u, p;
    for (const int steps : {16, 32}) {
      const State state = run(gamma, steps);
      u.push_back((state.u - reference.u).norm());
      p.push_back((state.p - reference.p).norm());
    }
    std::cout << fmt::format("gamma {}: u error {:.3e} order {:.2f}, p error {:.3e} order {:.2f}\n", gamma,
                             u.back(), order(u), p.back(), order(p));
    return {order(u), order(p)};
  }
};

TEST_F(InTime, order_2_for_velocity_and_pressure_at_gamma_one_half) {
  const auto [u, p] = orders(0.5);
  EXPECT_GT(u, 1.9);
  EXPECT_GT(p, 1.9);
}

TEST_F(InTime, order_1_at_gamma_1) {
  const auto [u, p] = orders(1.0);
  EXPECT_NEAR(u, 1, 0.15);
  EXPECT_NEAR(p, 1, 0.15);
}

TEST_F(InTime, the_estimate_of_a_steps_error_is_that_error_and_goes_with_the_cube_of_the_step) {
  std::vector<double> estimates;
  for (const double dt : {0.02, 0.01}) {
    NavierStokes solver(square(6), manufactured(0.5));
    const int steps = static_cast<int>(std::lround(0.3 / dt));
    for (int k = 1; k <= steps; ++k) {
      ASSERT_TRUE(solver.advance({k * dt, dt, 0, {}}).newton.converged);
      solver.accept();
    }
    NavierStokes finer(square(6), manufactured(0.5));
    finer.set_state(solver.state());
    const Result step = solver.advance({0.3 + dt, dt, 0, {}});
    solver.accept();
    for (int k = 1; k <= 16; ++k) {
      ASSERT_TRUE(finer.advance({0.3 + k * dt / 16, dt / 16, 0, {}}).newton.converged);
      finer.accept();
    }
    const double error = (solver.state().u - finer.state().u).norm() / solver.state().u.norm();
    EXPECT_EQ(step.time_error.power, 3);
    EXPECT_NEAR(step.time_error.relative, error, 0.25 * error);
    estimates.push_back(step.time_error.relative);
  }
  EXPECT_NEAR(std::log2(estimates[0] / estimates[1]), 3, 0.3);
}

/// Drag of a held disc in each of equal steps up to 0.8 s.
std::vector<double> drags(const std::string& inflow, double viscosity, int steps) {
  NavierStokes solver(
      square(16),
      settings(
          1, viscosity,
          {{"left", velocity(inflow, "0")}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}}));
  const std::vector<Interface> disc{circle(0, {0.4, 0.52}, 0.15, 1.0 / 16)};
  std::vector<double> forces;
  for (int k = 1; k <= steps; ++k) {
    const Result result = solver.advance({0.8 * k / steps, 0.8 / steps, 0, disc});
    EXPECT_TRUE(result.newton.converged) << result.newton.reason;
    forces.push_back(result.tractions[0].force.x());
    solver.accept();
  }
  return forces;
}

/// The largest second difference from step `first` on, over the force.
double ringing(const std::vector<double>& force, std::size_t first) {
  double largest = 0;
  for (std::size_t k = first; k + 1 < force.size(); ++k)
    largest = std::max(largest, std::abs((force[k + 1] - 2 * force[k] + force[k - 1]) / force[k]));
  return largest;
}

TEST(SuddenStart, forces_do_not_ring_from_step_to_step_and_converge_with_order_2) {
  const auto drag = [](int steps) { return drags("4*y*(1-y)", 0.01, steps); };
  const auto coarse = drag(20), fine = drag(40), finest = drag(160);
  EXPECT_LT(ringing(coarse, 8), 0.03);
  const double e1 = std::abs(coarse.back() - finest.back()), e2 = std::abs(fine.back() - finest.back());
  std::cout << fmt::format("sudden start: drag {:.6f}, errors {:.1e} and {:.1e}, order {:.2f}\n",
                           finest.back(), e1, e2, std::log2(e1 / e2));
  EXPECT_GT(std::log2(e1 / e2), 1.7);
}

TEST(SuddenStart, of_the_acceleration_alone_does_not_ring_either) {
  EXPECT_LT(ringing(drags("4*y*(1-y)*sin(t)", 0.01, 40), 8), 5e-3);
}

TEST_F(InTime, pressure_does_not_ring_from_step_to_step_at_gamma_one_half) {
  NavierStokes solver(square(6), manufactured(0.5));
  const double dt = 0.02;
  std::vector<double> p;
  for (int k = 1; k <= 20; ++k) {
    ASSERT_TRUE(solver.advance({k * dt, dt, 0, {}}).newton.converged);
    solver.accept();
    p.push_back(solver.at({0.21, 0.33})->second - solver.at({0.71, 0.37})->second);
  }
  // The first steps carry what the interpolated start leaves over. Third differences of a smooth signal are
  // of order Δt³; ringing would leave eight times its amplitude.
  double worst = 0, range = 0;
  for (std::size_t k = 8; k < p.size(); ++k) {
    worst = std::max(worst, std::abs(p[k] - 3 * p[k - 1] + 3 * p[k - 2] - p[k - 3]));
    range = std::max(range, std::abs(p[k]));
  }
  EXPECT_LT(worst, 1.5 * 27 * dt * dt * dt * range);
}

}  // namespace
}  // namespace fpi::fluid
