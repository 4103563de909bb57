/// Polygons embedded in the mesh, against exact flows and against a mesh that fits them.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

std::vector<Vec2> box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Largest distance of λ from a value on the edges that lie at least half in the mesh.
double traction_error(const Interface& body, const BodyTraction& result, const Vec2& exact) {
  double worst = 0;
  for (Index a = 0; a < body.n_arcs(); ++a) {
    const Vec2 middle = body.surface.at(0.5 * (body.start[a] + body.end[a]));
    if ((middle.array() > 0).all() && (middle.array() < 1).all())
      worst = std::max(worst, (result.lambda[a] - exact).norm());
  }
  return worst;
}

TEST(Polygons, couette_flow_above_a_wide_rectangle_is_exact) {
  const double mu = 0.7, floor = 0.2371;
  const auto exact = velocity("(y-0.2371)/(1-0.2371)", "0");
  auto s = settings(1, mu, {{"left", exact}, {"right", exact}, {"bottom", no_slip()}, {"top", exact}});
  NavierStokes solver(square(12), s);
  const Interface body = polygon({0.5, 0}, box(-1, -0.4, 1, floor), 1.0 / 12);
  const Result result = solve_steady(solver, {body});
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const double shear = mu / (1 - floor);
  EXPECT_LT(traction_error(body, result.tractions[0], {shear, 0}), 1e-9);
  EXPECT_NEAR(result.tractions[0].force.x(), shear, 1e-10);
  EXPECT_NEAR(result.tractions[0].torque, -shear * floor, 1e-10);
}

TEST(Polygons, poiseuille_flow_between_two_slabs_is_exact) {
  const double mu = 0.3, a = 0.2113, b = 0.8427, drive = 2;
  const auto exact = velocity(fmt::format("{}/2/{}*(y-{})*({}-y)", drive, mu, a, b), "0");
  auto s = settings(1, mu, {{"left", exact}, {"right", exact}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.body_force = {fmt::format("{}", drive), "0"};
  NavierStokes solver(square(10), s);
  std::vector<Interface> slabs{polygon({0.5, 0}, box(-1, -0.2, 1, a), 0.1),
                               polygon({0.5, 1}, box(-1, b - 1, 1, 0.3), 0.1)};
  slabs[1].body = 1;
  const Result result = solve_steady(solver, slabs);
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const double shear = drive * (b - a) / 2;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(traction_error(slabs[i], result.tractions[i], {shear, 0}), 1e-8) << i;
    EXPECT_NEAR(result.tractions[i].force.x(), shear, 1e-9) << i;
  }
}

TEST(Polygons, still_fluid_stays_still_and_a_polygon_feels_its_buoyancy_where_its_centroid_is) {
  auto s = settings(1000, 1e-3,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.gravity = {0, -9.81};
  NavierStokes solver(square(12), s);
  const Interface body =
      polygon({0.3, 0.4}, {{0, 0}, {0.3, 0}, {0.3, 0.1}, {0.1, 0.1}, {0.1, 0.3}, {0, 0.3}}, 0.08);
  const double area = 0.05, arm = (0.03 * 0.15 + 0.02 * 0.05) / area;
  for (int step = 1; step <= 2; ++step) {
    const Result result = solver.advance({0.1 * step, 0.1, 0, {body}});
    ASSERT_TRUE(result.newton.converged);
    for (const Vec2& lambda : result.tractions[0].lambda) EXPECT_EQ(lambda.norm(), 0);
    EXPECT_EQ(result.tractions[0].force.x(), 0);
    EXPECT_NEAR(result.tractions[0].force.y(), 1000 * 9.81 * area, 1e-10);
    EXPECT_NEAR(result.tractions[0].torque, 1000 * 9.81 * area * arm, 1e-10);
    solver.accept();
    EXPECT_EQ(solver.state().u.norm(), 0);
  }
}

TEST(Polygons, pressure_pushes_only_where_no_body_covers_the_boundary) {
  // Poiseuille flow above a slab, driven by the pressure at the left; the slab covers part of both ends.
  const double mu = 0.3, floor = 0.2371, pressure = 2;
  auto s = settings(1, mu,
                    {{"left", open(fmt::format("{}", pressure), "0")},
                     {"right", open()},
                     {"bottom", no_slip()},
                     {"top", no_slip()}});
  s.fluid.viscous_form = "gradient";
  NavierStokes solver(square(10), s);
  const Result result = solve_steady(solver, {polygon({0.5, 0}, box(-1, -0.4, 1, floor), 0.1)});
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const double gap = 1 - floor, y = 0.6;
  EXPECT_NEAR(solver.at({0.5, y})->first.x(), pressure / (2 * mu) * (y - floor) * (1 - y), 1e-4);
  EXPECT_NEAR(result.tractions[0].force.x(), pressure * gap / 2, 1e-3);
}

/// Steady torque of a square that spins in a closed box, in Stokes flow: at each angle it is another cut.
TEST(Polygons, torque_of_a_turning_square_changes_smoothly_over_its_angles) {
  auto s = settings(1, 0.5,
                    {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.convection = false;
  std::vector<double> torque;
  for (int k = 0; k < 20; ++k) {
    NavierStokes solver(square(20), s);
    Interface body = polygon({0.51, 0.48}, box(-0.15, -0.15, 0.15, 0.15), 0.05, k * pi / 40);
    body.rigid.spin = 1;
    const Result result = solve_steady(solver, {body});
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    torque.push_back(result.tractions[0].torque);
  }
  double noise = 0;
  for (std::size_t k = 1; k + 1 < torque.size(); ++k)
    noise = std::max(noise, std::abs(torque[k + 1] - 2 * torque[k] + torque[k - 1]) / 4);
  std::cout << fmt::format("turning square: torque {:.5f} to {:.5f}, noise {:.1e}\n", torque.front(),
                           torque[10], noise / std::abs(torque[0]));
  for (const double value : torque) EXPECT_LT(value, 0);
  EXPECT_LT(noise, 0.01 * std::abs(torque[0]));
}

/// A channel [0, 1.5] × [0, 0.5] with a step 0.2 high on its floor from x = 0.6 on; the fitted mesh has the
/// boundary "step".
constexpr double step_start = 0.6, step_height = 0.2;

Mesh step_mesh(int cells_per_unit) {
  const Mesh whole = make_rectangle(uniform_lines(0, 1.5, 3 * cells_per_unit / 2),
                                    uniform_lines(0, 0.5, cells_per_unit / 2));
  const auto in_step = [&](Index c) {
    const auto k = whole.corners(c);
    const Vec2 middle = (k[0] + k[1] + k[2]) / 3;
    return middle.x() > step_start && middle.y() < step_height;
  };
  std::vector<Index> number(whole.n_vertices(), -1);
  std::vector<Vec2> vertices;
  std::vector<std::array<Index, 3>> cells;
  for (Index c = 0; c < whole.n_cells(); ++c) {
    if (in_step(c)) continue;
    cells.push_back(whole.cells[c]);
    for (Index& v : cells.back()) {
      if (number[v] < 0) {
        number[v] = static_cast<Index>(vertices.size());
        vertices.push_back(whole.vertices[v]);
      }
      v = number[v];
    }
  }
  std::vector<NamedEdge> named;
  auto names = whole.boundary_names;
  names.emplace_back("step");
  for (const BoundaryEdge& b : whole.boundary)
    if (!in_step(b.cell))
      named.push_back({{number[whole.edges[b.edge][0]], number[whole.edges[b.edge][1]]}, b.boundary});
  for (Index e = 0; e < whole.n_edges(); ++e) {
    const auto [c1, c2] = whole.edge_cells[e];
    if (c2 >= 0 && in_step(c1) != in_step(c2))
      named.push_back(
          {{number[whole.edges[e][0]], number[whole.edges[e][1]]}, static_cast<Index>(names.size()) - 1});
  }
  return make_mesh(std::move(vertices), std::move(cells), named, std::move(names));
}

TEST(Polygons, a_step_embedded_feels_the_force_of_a_step_that_the_mesh_fits) {
  auto s = settings(1, 0.01,
                    {{"left", velocity("16*y*(0.5-y)", "0")},
                     {"right", open()},
                     {"bottom", no_slip()},
                     {"top", no_slip()}});
  const auto fitted = [&](int n) {
    auto with_step = s;
    with_step.fluid.boundaries["step"] = no_slip();
    NavierStokes solver(step_mesh(n), with_step);
    EXPECT_TRUE(solve_steady(solver).newton.converged);
    const auto& curves = solver.boundary_curves();
    for (std::size_t b = 0; b < curves.size(); ++b)
      if (curves[b].name == "step") return solver.boundary_tractions()[b].force;
    return Vec2(0, 0);
  };
  const Vec2 reference = fitted(80);
  const double h = 1.0 / 42;  // no grid line of which runs along the step
  NavierStokes solver(make_rectangle(uniform_lines(0, 1.5, 63), uniform_lines(0, 0.5, 21)), s);
  const Interface body = polygon({0.6, 0}, box(0, -0.05, 1, step_height), h);
  const Result result = solve_steady(solver, {body});
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const Vec2 force = result.tractions[0].force, coarse = fitted(40);
  std::cout << fmt::format(
      "step: force fitted ({:.6f}, {:.6f}), coarser ({:.1e}, {:.1e}), embedded ({:.1e}, {:.1e})\n",
      reference.x(), reference.y(), coarse.x() / reference.x() - 1, coarse.y() / reference.y() - 1,
      force.x() / reference.x() - 1, force.y() / reference.y() - 1);
  EXPECT_NEAR(force.x(), reference.x(), 5e-3 * std::abs(reference.x()));
  EXPECT_NEAR(force.y(), reference.y(), 5e-3 * std::abs(reference.y()));
}

}  // namespace
}  // namespace fpi::fluid
