// Rectangles refined by bisection: conforming, as fine as asked for, growing smoothly.
#include <gtest/gtest.h>

#include <set>

#include "core/error.hpp"
#include "fluid/mesh/bisection.hpp"
#include "fluid/mesh/rectangle.hpp"
#include "fluid/mesh/size_field.hpp"

namespace fpi::fluid {
namespace {

scene::Refinement box(double size, std::vector<double> corners, double growth = 0.25) {
  scene::Refinement r;
  r.size = size;
  r.growth = growth;
  r.box = std::move(corners);
  return r;
}

scene::Refinement circle(double size, std::vector<double> centre, double radius) {
  scene::Refinement r;
  r.size = size;
  r.centre = std::move(centre);
  r.radius = radius;
  return r;
}

scene::Refinement line(double size, std::vector<double> points) {
  scene::Refinement r;
  r.size = size;
  r.line = std::move(points);
  return r;
}

Mesh channel(std::vector<scene::Refinement> refinements) {
  return make_rectangle(uniform_lines(0, 2, 20), uniform_lines(0, 1, 10), refinements);
}

TEST(Refinement, distances_from_regions_are_exact) {
  EXPECT_EQ(distance(box(1, {0, 0, 2, 1}), {1, 0.5}), 0);
  EXPECT_EQ(distance(box(1, {0, 0, 2, 1}), {5, 5}), 5);
  EXPECT_EQ(distance(circle(1, {1, 0}, 2), {1, 0}), 2);
  EXPECT_EQ(distance(circle(1, {1, 0}, 2), {6, 0}), 3);
  EXPECT_EQ(distance(line(1, {0, 0, 1, 0, 1, 3}), {3, 2}), 2);
  EXPECT_EQ(distance(line(1, {0, 0, 1, 0, 1, 3}), {4, 7}), 5);
}

TEST(Refinement, every_triangle_is_as_small_as_is_wanted_at_its_vertices_and_centre) {
  const std::vector<scene::Refinement> refinements{
      box(0.02, {0.5, 0.2, 0.6, 0.3}), circle(0.01, {1, 0.5}, 0.2), line(0.015, {1.5, 0, 2, 0.5, 2, 1})};
  const Mesh mesh = channel(refinements);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto corner = mesh.corners(c);
    for (const Vec2& x : {corner[0], corner[1], corner[2], Vec2((corner[0] + corner[1] + corner[2]) / 3)})
      EXPECT_LE(mesh.size(c), wanted_size(refinements, x, 0) * (1 + 1e-8));
  }
}

TEST(Refinement, a_size_that_halving_meets_exactly_is_not_passed) {
  const Mesh mesh = make_rectangle(uniform_lines(0, 0.3, 3), uniform_lines(0, 0.3, 3),
                                   std::vector{box(0.1 / 8, {0, 0, 0.3, 0.3})});
  for (Index c = 0; c < mesh.n_cells(); ++c) EXPECT_NEAR(mesh.size(c), 0.1 / 8, 1e-12);
}

TEST(Refinement, triangles_stay_right_and_fill_the_rectangle_without_hanging_nodes) {
  const Mesh mesh =
      channel({circle(0.004, {1, 0.5}, 0.2)});  // make_mesh would refuse an unnamed or crossed edge
  EXPECT_EQ(mesh.n_vertices() - mesh.n_edges() + mesh.n_cells(), 1);
  double area = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    area += mesh.area(c);
    std::array<double, 3> sides;
    for (int k = 0; k < 3; ++k) sides[k] = (mesh.corners(c)[k] - mesh.corners(c)[(k + 1) % 3]).squaredNorm();
    std::ranges::sort(sides);
    EXPECT_NEAR(sides[0] / sides[1], 1, 1e-9);
    EXPECT_NEAR(sides[2] / sides[1], 2, 1e-9);
  }
  EXPECT_NEAR(area, 2, 1e-12);
  std::set<std::pair<double, double>> places;
  for (const Vec2& v : mesh.vertices) EXPECT_TRUE(places.emplace(v.x(), v.y()).second);
}

TEST(Refinement, neighbours_differ_by_one_halving_or_two_and_nothing_far_away_is_refined) {
  const Mesh mesh = channel({circle(0.004, {0.5, 0.5}, 0.1)});
  double largest = 0;
  for (Index e = 0; e < mesh.n_edges(); ++e) {
    const auto [one, other] = mesh.edge_cells[e];
    if (other == -1) continue;
    const double ratio = mesh.area(one) / mesh.area(other);
    EXPECT_LT(std::max(ratio, 1 / ratio), 2.01);
  }
  for (Index c = 0; c < mesh.n_cells(); ++c) largest = std::max(largest, mesh.size(c));
  EXPECT_NEAR(largest, 0.1, 1e-12);
  EXPECT_LT(mesh.n_cells(), 8000);  // uniform at 0.004: 250000
}

TEST(Refinement, no_triangle_has_all_its_vertices_on_the_boundary) {
  for (const int nx : {1, 2, 3})
    for (const int ny : {1, 2, 5})
      for (const double size : {0.02, 0.1, 10.0}) {
        const std::vector<scene::Refinement> refinements{box(size, {0, 0, 0.1, 0.1})};
        const Mesh mesh = make_rectangle(uniform_lines(0, 2, nx), uniform_lines(0, 1, ny), refinements);
        std::vector<int> outer(mesh.n_vertices(), 0);
        for (const BoundaryEdge& b : mesh.boundary)
          for (const Index v : mesh.edges[b.edge]) outer[v] = 1;
        for (const auto& v : mesh.cells) EXPECT_LT(outer[v[0]] + outer[v[1]] + outer[v[2]], 3);
      }
}

TEST(Refinement, sides_keep_their_names) {
  const Mesh mesh = channel({box(0.01, {0, 0, 0.05, 0.05}), box(0.02, {2, 1, 2, 1})});
  std::array<double, 4> length{};
  for (const BoundaryEdge& b : mesh.boundary) {
    const Vec2 x = mesh.chord_middle(b.edge);
    const std::array<bool, 4> on_side{x.x() == 0, x.x() == 2, x.y() == 0, x.y() == 1};
    EXPECT_TRUE(on_side[b.boundary]);
    const EdgeNodes ends = mesh.places(mesh.edge_nodes(b));
    length[b.boundary] += (ends[1] - ends[0]).norm();
  }
  EXPECT_NEAR(length[0], 1, 1e-13);
  EXPECT_NEAR(length[1], 1, 1e-13);
  EXPECT_NEAR(length[2], 2, 1e-13);
  EXPECT_NEAR(length[3], 2, 1e-13);
}

TEST(Refinement, sizes_beyond_all_measure_are_refused) {
  EXPECT_THROW(channel({box(1e-9, {0, 0, 2, 1})}), Error);
}

}  // namespace
}  // namespace fpi::fluid
