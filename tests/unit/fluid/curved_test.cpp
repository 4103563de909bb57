// Triangles with parabolic edges: geometry, location, conditions on the boundary, fitted circles.
#include <gtest/gtest.h>

#include <random>

#include "core/error.hpp"
#include "fluid/base/quadrature.hpp"
#include "fluid/discretisation/boundary.hpp"
#include "fluid/mesh/circle_fit.hpp"
#include "fluid/mesh/isoparametric.hpp"
#include "fluid/mesh/locator.hpp"
#include "ring.hpp"

namespace fpi::fluid {
namespace {

constexpr double pi = std::numbers::pi;

double area(const Mesh& mesh) {
  double sum = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (const ElementPoint& p : curved_points())
      sum += p.weight * metric_at(mesh.cell_places(c), p.shape).area;
  return sum;
}

double length(const Mesh& mesh, Index boundary) {
  double sum = 0;
  for (const BoundaryEdge& b : mesh.boundary)
    for (const LinePoint& p : gauss_legendre(8))
      if (b.boundary == boundary) sum += p.weight * edge_tangent(mesh.places(mesh.edge_nodes(b)), p.s).norm();
  return sum;
}

scene::Boundary condition(const std::string& type, std::vector<std::string> values = {"0", "0"}) {
  scene::Boundary b;
  b.type = type;
  (type == "traction" ? b.traction : b.velocity) = std::move(values);
  return b;
}

TEST(Curved, area_of_a_parabolic_segment_is_exact) {
  const Vec2 middle(0.5, -0.1);
  const Mesh mesh = make_mesh({{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}, {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}},
                              {"all"}, {{{1, 0}, middle}});
  EXPECT_NEAR(area(mesh), 0.5 + 2.0 / 3 * 0.1, 1e-15);
  EXPECT_TRUE(mesh.is_curved(0));
  EXPECT_EQ(mesh.node_position(3), middle);
}

TEST(Curved, areas_and_arcs_of_a_ring_converge_with_order_four) {
  const double exact_area = pi * (1 - 0.25);
  std::array<double, 3> area_error, arc_error;
  for (int k = 0; k < 3; ++k) {
    const Mesh mesh = make_ring(8 << k, 2, 0.5, 1);
    area_error[k] = std::abs(area(mesh) / exact_area - 1);
    arc_error[k] = std::abs(length(mesh, 0) / pi - 1);
  }
  EXPECT_LT(area_error[0], 1e-3);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::log2(area_error[k] / area_error[k + 1]), 4, 0.1);
    EXPECT_NEAR(std::log2(arc_error[k] / arc_error[k + 1]), 4, 0.1);
  }
}

TEST(Curved, a_middle_beside_the_chord_by_round_off_is_put_on_it) {
  const auto mesh_with = [](double off) {
    return make_mesh({{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}, {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}}, {"all"},
                     {{{0, 1}, {0.5, off}}});
  };
  EXPECT_FALSE(mesh_with(1e-10).is_curved(0));
  EXPECT_TRUE(mesh_with(1e-8).is_curved(0));
}

TEST(Curved, a_folded_triangle_is_refused_with_its_place) {
  const auto refusal = [](const std::vector<EdgeMiddle>& middles) -> std::string {
    try {
      make_mesh({{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}, {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}}, {"all"},
                middles);
    } catch (const Error& e) {
      return e.what();
    }
    return "taken";
  };
  EXPECT_EQ(refusal({{{0, 1}, {0.5, 0.2}}}), "taken");
  EXPECT_NE(refusal({{{0, 1}, {0.5, 0.4}}}).find("folded"), std::string::npos);
  EXPECT_NE(refusal({{{0, 1}, {0.1, 0}}}).find("(0, 0) m"), std::string::npos);
  EXPECT_NE(refusal({{{0, 1}, {std::nan(""), 0}}}).find("folded"), std::string::npos);
  EXPECT_NE(refusal({{{0, 1}, {0.5, 0.1}}, {{1, 0}, {0.5, 0.2}}}).find("one middle node"), std::string::npos);
  EXPECT_NE(refusal({{{0, 9}, {0.5, 0.1}}}).find("edge of a triangle"), std::string::npos);
}

TEST(Curved, the_inverse_of_the_map_gives_every_point_back) {
  const Mesh mesh = make_ring(8, 1, 0.5, 1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (int i = 0; i < 100; ++i) {
      double a = uniform(random), b = uniform(random);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const CellNodes nodes = mesh.cell_places(c);
      const auto l = isoparametric_inverse(nodes, position_at(nodes, p2_at({1 - a - b, a, b})));
      ASSERT_TRUE(l);
      EXPECT_NEAR((*l)[1], a, 1e-14);
      EXPECT_NEAR((*l)[2], b, 1e-14);
    }
}

TEST(Curved, points_of_the_ring_are_found_up_to_the_circle_and_points_of_the_hole_are_not) {
  const Mesh mesh = make_ring(12, 3, 0.5, 1);
  const Locator locator(mesh);
  for (int i = 0; i < 500; ++i) {
    const double angle = 0.1 * i;
    const Vec2 direction(std::cos(angle), std::sin(angle));
    for (const double r : {0.5, 0.502, 0.51, 0.66, 0.8, 0.99, 1.0}) {
      const auto place = locator.find(r * direction);
      ASSERT_TRUE(place) << r << " at " << angle;
      EXPECT_NEAR((position_at(mesh.cell_places(place->cell), p2_at(place->l)) - r * direction).norm(), 0,
                  1e-12);
    }
    EXPECT_FALSE(locator.find(0.49 * direction));
    EXPECT_FALSE(locator.find(1.01 * direction));
  }
}

TEST(Curved, a_pressure_on_a_closed_curve_has_no_resultant) {
  const Mesh mesh = make_ring(12, 1, 0.5, 1);
  const Boundary boundary(mesh,
                          {{"inner", condition("no_slip")}, {"outer", condition("traction", {"x", "y"})}});
  Vector load = Vector::Zero(2 * mesh.n_nodes());
  boundary.add_tractions(0, {}, load);
  double x = 0, radial = 0;
  for (Index n = 0; n < mesh.n_nodes(); ++n) {
    x += load[2 * n];
    radial += load.segment<2>(2 * n).dot(mesh.node_position(n));
  }
  EXPECT_NEAR(x, 0, 1e-14);
  EXPECT_NEAR(radial, 2 * pi, 2e-3);  // ∫ x·x, of degree 4 and more, by nodes
}

TEST(Curved, slip_normals_of_a_circle_point_along_the_radius) {
  const Mesh mesh = make_ring(16, 1, 0.5, 1);
  const Boundary boundary(mesh, {{"inner", condition("slip")}, {"outer", condition("slip")}});
  for (const BoundaryEdge& b : mesh.boundary)
    for (const Index node : mesh.edge_nodes(b)) {
      ASSERT_EQ(boundary.constraint(node), Constraint::normal);
      EXPECT_NEAR(std::abs(boundary.normal(node).dot(mesh.node_position(node).normalized())), 1, 1e-14);
    }
}

TEST(Curved, flow_along_slip_walls_is_balanced_and_a_source_is_not) {
  const Mesh mesh = make_ring(16, 1, 0.5, 1);
  const Boundary boundary(mesh, {{"inner", condition("slip")}, {"outer", condition("velocity", {"x", "y"})}});
  Vector spin = Vector::Zero(2 * mesh.n_nodes()), uniform = spin, source = spin;
  for (Index n = 0; n < mesh.n_nodes(); ++n) {
    const Vec2 x = mesh.node_position(n);
    spin.segment<2>(2 * n) = Vec2(-x.y(), x.x());
    uniform.segment<2>(2 * n) = Vec2(1, 2);
    source.segment<2>(2 * n) = x / x.squaredNorm() + 0.1 * x;
  }
  EXPECT_NO_THROW(boundary.check_net_flux(0, spin));
  EXPECT_NO_THROW(boundary.check_net_flux(0, spin + uniform));
  EXPECT_THROW(boundary.check_net_flux(0, source), Error);
}

TEST(CircleFit, a_polygon_becomes_the_circle_that_its_vertices_are_on) {
  const Mesh curved = make_ring(12, 2, 0.5, 1);
  Mesh mesh = make_ring(12, 2, 0.5, 1, false);
  fit_circle(mesh, "inner", {0, 0}, 0.5);
  fit_circle(mesh, "outer", {0, 0}, 1);
  EXPECT_NEAR(area(mesh), area(curved), 1e-14);
  fit_circle(mesh, "outer", {0, 0}, 1.02);  // vertices move too, and edges across stay straight
  EXPECT_NEAR(length(mesh, 1), 1.02 * length(curved, 1), 1e-14);
  for (Index e = 0; e < mesh.n_edges(); ++e) EXPECT_EQ(mesh.is_curved_edge(e), mesh.edge_cells[e][1] == -1);
}

TEST(CircleFit, another_name_or_a_far_circle_is_refused) {
  Mesh mesh = make_ring(12, 2, 0.5, 1, false);
  EXPECT_THROW(fit_circle(mesh, "inside", {0, 0}, 0.5), Error);
  EXPECT_THROW(fit_circle(mesh, "inner", {0, 0}, 0.7), Error);
  EXPECT_THROW(fit_circle(mesh, "inner", {0.5, 0}, 0.5), Error);
}

}  // namespace
}  // namespace fpi::fluid
