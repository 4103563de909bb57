/// Flows that the element represents exactly.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;

TEST(Channel, poiseuille_flow_is_exact_to_round_off) {
  auto s = settings(1.3, 0.7,
                    {{"left", velocity("4*y*(1-y)", "0")},
                     {"right", open("0", "0.7*4*(1-2*y)")},
                     {"bottom", no_slip()},
                     {"top", no_slip()}});
  NavierStokes solver(make_rectangle(uniform_lines(0, 2, 6), uniform_lines(0, 1, 5)), s);
  const Result result = solve_steady(solver);
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const auto e = errors(
      solver, [](const Vec2& x) { return Vec2(4 * x.y() * (1 - x.y()), 0); },
      [](const Vec2& x) { return (Eigen::Matrix2d() << 0, 4 - 8 * x.y(), 0, 0).finished(); },
      [](const Vec2& x) { return -8 * 0.7 * (x.x() - 2); });  // the open side sets the level
  EXPECT_LT(e.velocity_l2, 1e-13);
  EXPECT_LT(e.velocity_h1, 1e-12);
  EXPECT_LT(e.pressure_l2, 1e-12);
}

TEST(Channel, slip_walls_carry_a_uniform_flow_and_no_force) {
  auto s =
      settings(1, 1, {{"left", velocity("2", "0")}, {"right", open()}, {"bottom", slip()}, {"top", slip()}});
  NavierStokes solver(square(4), s);
  const Result result = solve_steady(solver);
  ASSERT_TRUE(result.newton.converged);
  EXPECT_NEAR(result.speed, 2, 1e-13);
  EXPECT_NEAR((solver.at({0.3, 1.0})->first - Vec2(2, 0)).norm(), 0, 1e-13);
  for (const BoundaryTraction& t : solver.boundary_tractions()) EXPECT_NEAR(t.force.norm(), 0, 1e-12);
}

/// A slip wall at 30 degrees: the same uniform flow along it, which needs the turned unknowns.
TEST(Channel, an_inclined_slip_wall_lets_the_flow_along_it_pass) {
  const double c = std::cos(std::numbers::pi / 6), sn = std::sin(std::numbers::pi / 6);
  const Mesh straight = square(4);
  std::vector<Vec2> vertices;
  for (const Vec2& v : straight.vertices)
    vertices.emplace_back(c * v.x() - sn * v.y(), sn * v.x() + c * v.y());
  std::vector<NamedEdge> edges;
  for (const BoundaryEdge& b : straight.boundary) edges.push_back({straight.edges[b.edge], b.boundary});
  auto s = settings(1, 1,
                    {{"left", velocity(std::to_string(c), std::to_string(sn))},
                     {"right", open()},
                     {"bottom", slip()},
                     {"top", slip()}});
  NavierStokes solver(make_mesh(vertices, straight.cells, edges, straight.boundary_names), s);
  ASSERT_TRUE(solve_steady(solver).newton.converged);
  for (Index n = 0; n < solver.mesh().n_nodes(); ++n)
    EXPECT_NEAR((solver.state().u.segment<2>(2 * n) - Vec2(c, sn)).norm(), 0, 1e-6);
}

TEST(Channel, an_inlet_without_an_outlet_is_refused_with_the_net_flux) {
  auto s = settings(1, 1,
                    {{"left", velocity("4*y*(1-y)", "0")},
                     {"right", no_slip()},
                     {"bottom", no_slip()},
                     {"top", no_slip()}});
  NavierStokes solver(square(4), s);
  try {
    solve_steady(solver);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("a net 0.666667 m²/s enters"), std::string::npos) << e.what();
  }
}

TEST(StillFluid, stays_still_around_a_held_body_which_feels_its_buoyancy) {
  auto s = settings(1000, 1e-3,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.gravity = {0, -9.81};
  NavierStokes solver(square(12), s);
  Request request{0.1, 0.1, 0, {circle(0, {0.52, 0.47}, 0.2, 1.0 / 12)}};
  for (int step = 0; step < 3; ++step) {
    const Result result = solver.advance(request);
    ASSERT_TRUE(result.newton.converged);
    EXPECT_EQ(result.tractions[0].force.x(), 0);
    EXPECT_DOUBLE_EQ(result.tractions[0].force.y(), 1000 * 9.81 * std::numbers::pi * 0.04);
    solver.accept();
    EXPECT_EQ(solver.state().u.norm(), 0);
    request.time += 0.1;
  }
}

}  // namespace
}  // namespace fpi::fluid
