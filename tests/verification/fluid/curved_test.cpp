/// Flows between round walls that the mesh fits with parabolic edges.
#include <gtest/gtest.h>

#include "../../unit/fluid/ring.hpp"
#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;

/// Stokes flow between an inner wall that turns with 1 rad/s and the outer one.
Settings turning(const scene::Boundary& outer) {
  Settings s = settings(1, 1, {{"inner", velocity("-y", "x")}, {"outer", outer}});
  s.fluid.convection = false;
  return s;
}

/// Taylor and Couette: u = a r + b/r along the circle, inner wall r = ½, outer wall r = 1 at rest.
struct Couette {
  double b = 1.0 / 3, a = -b;
  Vec2 u(const Vec2& x) const { return (a + b / x.squaredNorm()) * Vec2(-x.y(), x.x()); }
  Eigen::Matrix2d du(const Vec2& x) const {
    const double r2 = x.squaredNorm();
    const Eigen::Matrix2d turn = (Eigen::Matrix2d() << 0, -1, 1, 0).finished();
    return (a + b / r2) * turn - 2 * b / (r2 * r2) * (turn * x) * x.transpose();
  }
};

Errors couette_errors(int n, bool curved) {
  const Couette exact;
  NavierStokes solver(make_ring(6 * n, n, 0.5, 1, curved), turning(no_slip()));
  const Result result = solve_steady(solver);
  EXPECT_TRUE(result.newton.converged) << result.newton.reason;
  return errors(
      solver, [&](const Vec2& x) { return exact.u(x); }, [&](const Vec2& x) { return exact.du(x); },
      [](const Vec2&) { return 0; });
}

TEST(CurvedFlow, parabolic_edges_keep_the_orders_that_straight_ones_lose) {
  std::vector<double> l2, h1, p, straight;
  for (const int n : {3, 6, 12}) {
    const Errors e = couette_errors(n, true);
    l2.push_back(e.velocity_l2);
    h1.push_back(e.velocity_h1);
    p.push_back(e.pressure_l2);
    straight.push_back(couette_errors(n, false).velocity_l2);
  }
  std::cout << fmt::format(
      "Taylor-Couette fitted: u L2 {:.3e} order {:.2f}, H1 {:.3e} order {:.2f}, p L2 {:.3e} order {:.2f}; "
      "straight u L2 {:.3e} order {:.2f}\n",
      l2.back(), order(l2), h1.back(), order(h1), p.back(), order(p), straight.back(), order(straight));
  EXPECT_GT(order(l2), 2.85);
  EXPECT_GT(order(h1), 1.9);
  EXPECT_GT(order(p), 1.9);
  EXPECT_LT(order(straight), 2.2);
  EXPECT_LT(l2.back(), 0.1 * straight.back());
}

TEST(CurvedFlow, fluid_in_a_slippery_round_wall_turns_as_a_rigid_body_to_round_off) {
  NavierStokes solver(make_ring(12, 2, 0.5, 1), turning(slip()));
  const Result result = solve_steady(solver);
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  for (Index n = 0; n < solver.mesh().n_nodes(); ++n) {
    const Vec2 x = solver.mesh().node_position(n);
    EXPECT_NEAR((solver.state().u.segment<2>(2 * n) - Vec2(-x.y(), x.x())).norm(), 0, 1e-11);
  }
}

}  // namespace
}  // namespace fpi::fluid
