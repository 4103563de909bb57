/// Profiles along segments, and errors against an exact flow.
#include <gtest/gtest.h>

#include "fluid/measure/exact.hpp"
#include "fluid/measure/profile.hpp"
#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {
namespace {

Mesh unit_square(int n) { return make_rectangle(uniform_lines(0, 1, n), uniform_lines(0, 1, n)); }

TEST(Profile, finds_the_extrema_of_a_parabola_between_samples) {
  const Mesh mesh = unit_square(3);
  const Locator locator(mesh);
  const auto profile = measure_profile(mesh, locator, {0.1, 0.2}, {0.9, 0.2}, [](const Vec2& x) {
    return std::optional(3 - 2 * (x.x() - 0.437) * (x.x() - 0.437));
  });
  ASSERT_TRUE(profile);
  EXPECT_NEAR(profile->largest.value, 3, 1e-14);
  EXPECT_NEAR(profile->largest.place.x(), 0.437, 1e-9);
  EXPECT_EQ(profile->smallest.place, Vec2(0.9, 0.2));
}

TEST(Profile, along_edges_of_the_mesh_has_every_vertex_and_middle_once) {
  const Mesh mesh = unit_square(4);
  const Locator locator(mesh);
  const auto profile =
      measure_profile(mesh, locator, {0.5, 0}, {0.5, 1}, [](const Vec2& x) { return std::optional(x.y()); });
  ASSERT_TRUE(profile);
  ASSERT_EQ(profile->points.size(), 9u);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(profile->points[i].value, i / 8.0, 1e-12);
}

TEST(Profile, leaves_out_what_has_no_value) {
  const Mesh mesh = unit_square(4);
  const Locator locator(mesh);
  const auto outside_body = [](const Vec2& x) { return x.x() < 0.6 ? std::optional(x.x()) : std::nullopt; };
  const auto profile = measure_profile(mesh, locator, {0, 0.3}, {1, 0.3}, outside_body);
  ASSERT_TRUE(profile);
  EXPECT_LT(profile->largest.value, 0.6);
  EXPECT_FALSE(measure_profile(mesh, locator, {0.7, 0.3}, {1, 0.3}, outside_body));
}

/// Interpolates a flow into the nodes.
State interpolated(const Mesh& mesh, const ExactFlow& flow) {
  State state;
  state.u = Vector::Zero(2 * mesh.n_nodes());
  state.p = Vector::Zero(mesh.n_vertices());
  for (Index n = 0; n < mesh.n_nodes(); ++n) state.u.segment<2>(2 * n) = flow.velocity(mesh.node_position(n));
  for (Index v = 0; v < mesh.n_vertices(); ++v) state.p[v] = flow.pressure(mesh.vertices[v]);
  return state;
}

struct FlowErrorsTest : testing::Test {
  Mesh mesh = unit_square(3);
  Locator locator{mesh};
  CutMesh cut = cut_mesh(mesh, locator, {});
  ExactFlow quadratic{[](const Vec2& x) { return Vec2(x.x() * x.x() - x.y(), x.x() * x.y()); },
                      [](const Vec2& x) { return 2 * x.x() - x.y(); }};
};

TEST_F(FlowErrorsTest, vanish_for_a_flow_that_the_element_represents) {
  const FlowErrors e = flow_errors(mesh, cut, interpolated(mesh, quadratic), quadratic, false);
  EXPECT_LT(e.velocity_l2, 1e-14);
  EXPECT_LT(e.velocity_h1, 1e-9);  // the exact gradient comes from differences
  EXPECT_LT(e.pressure_l2, 1e-14);
}

TEST_F(FlowErrorsTest, are_the_norms_of_a_known_difference) {
  State state = interpolated(mesh, quadratic);
  for (Index n = 0; n < mesh.n_nodes(); ++n) state.u[2 * n] += mesh.node_position(n).x();
  for (Index v = 0; v < mesh.n_vertices(); ++v) state.p[v] += 5 + mesh.vertices[v].y();
  const FlowErrors e = flow_errors(mesh, cut, state, quadratic, false);
  EXPECT_NEAR(e.velocity_l2, std::sqrt(1.0 / 3), 1e-13);
  EXPECT_NEAR(e.velocity_h1, 1, 1e-9);
  EXPECT_NEAR(e.pressure_l2, std::sqrt(25 + 5 + 1.0 / 3), 1e-12);
  EXPECT_NEAR(flow_errors(mesh, cut, state, quadratic, true).pressure_l2, std::sqrt(1.0 / 12), 1e-12);
}

}  // namespace
}  // namespace fpi::fluid
