#include "fluid/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/error.hpp"
#include "fluid/mesh/locator.hpp"
#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {
namespace {

TEST(Mesh, euler_formula_holds_and_areas_add_up) {
  const Mesh mesh = make_rectangle(graded_lines(0, 2.2, 0.1, 0.4, 0.02, 1.2, 0.2), uniform_lines(0, 0.41, 7));
  EXPECT_EQ(mesh.n_vertices() - mesh.n_edges() + mesh.n_cells(), 1);
  double area = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_GT(mesh.area(c), 0);
    area += mesh.area(c);
  }
  EXPECT_NEAR(area, 2.2 * 0.41, 1e-13);
}

TEST(Mesh, no_triangle_of_a_rectangle_has_two_sides_on_the_boundary) {
  for (const int nx : {2, 3, 4, 5})
    for (const int ny : {2, 3, 4, 5}) {
      const Mesh mesh = make_rectangle(uniform_lines(0, 1, nx), uniform_lines(0, 1, ny));
      std::vector<int> sides(mesh.n_cells(), 0);
      for (const BoundaryEdge& b : mesh.boundary) EXPECT_LE(++sides[b.cell], 1) << nx << " × " << ny;
    }
}

TEST(Mesh, a_clockwise_triangle_is_turned) {
  const Mesh mesh =
      make_mesh({{0, 0}, {1, 0}, {0, 1}}, {{0, 2, 1}}, {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}}, {"all"});
  EXPECT_DOUBLE_EQ(mesh.area(0), 0.5);
}

TEST(Mesh, faults_are_refused_with_the_place) {
  const std::vector<Vec2> vertices{{0, 0}, {1, 0}, {0, 1}, {2, 0}};
  EXPECT_THROW(make_mesh(vertices, {{0, 1, 3}}, {}, {}), Error);                // degenerate
  EXPECT_THROW(make_mesh(vertices, {{0, 1, 9}}, {}, {}), Error);                // no such vertex
  EXPECT_THROW(make_mesh(vertices, {{0, 1, 2}}, {{{0, 1}, 0}}, {"a"}), Error);  // unnamed sides
  EXPECT_THROW(make_mesh(vertices, {{0, 1, 2}}, {{{0, 3}, 0}}, {"a"}), Error);  // a side of no triangle
  EXPECT_THROW(make_mesh(vertices, {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}}, {}, {}), Error);
  EXPECT_THROW(make_mesh(vertices, {{0, 1, 2}, {0, 1, 2}}, {}, {}), Error);  // one on the other
}

TEST(Mesh, an_edge_with_two_names_has_the_first) {
  const Mesh mesh = make_mesh({{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}},
                              {{{0, 1}, 1}, {{1, 2}, 1}, {{2, 0}, 0}, {{1, 0}, 0}}, {"a", "b"});
  std::vector<Index> found;
  for (const BoundaryEdge& b : mesh.boundary) found.push_back(b.boundary);
  EXPECT_EQ(found, (std::vector<Index>{1, 1, 0}));
}

TEST(Mesh, graded_lines_keep_the_fine_size_and_grow_by_the_ratio) {
  const auto lines = graded_lines(0, 10, 4, 5, 0.1, 1.3, 0.7);
  EXPECT_EQ(lines.front(), 0);
  EXPECT_EQ(lines.back(), 10);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double size = lines[i] - lines[i - 1];
    EXPECT_GT(size, 0.085);
    EXPECT_LT(size, 0.8);
    if (lines[i - 1] > 3.999 && lines[i] < 5.001) {
      EXPECT_NEAR(size, 0.1, 1e-12);
    }
    if (i > 1) {
      const double ratio = size / (lines[i - 1] - lines[i - 2]);
      EXPECT_LT(ratio, 1.5);
      EXPECT_GT(ratio, 1 / 1.5);
    }
  }
}

TEST(Mesh, cells_beyond_all_measure_are_refused) {
  EXPECT_THROW(graded_lines(0, 1, 0, 1, 1e-9, 1.2, 0), Error);
  EXPECT_THROW(graded_lines(0, 1, 0, 0.1, 2e-6, 1, 2e-6), Error);
  EXPECT_THROW(make_rectangle(uniform_lines(0, 1, 5000), uniform_lines(0, 1, 5000)), Error);
}

TEST(Locator, finds_the_triangle_of_every_point) {
  const Mesh mesh = make_rectangle(graded_lines(0, 2, 0.5, 0.6, 0.01, 1.3, 0), uniform_lines(0, 1, 9));
  const Locator locator(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 x(2 * uniform(random), uniform(random));
    const auto place = locator.find(x);
    ASSERT_TRUE(place);
    for (double l : place->l) EXPECT_GE(l, -1e-10);
    EXPECT_NEAR((Triangle(mesh.corners(place->cell)).point(place->l) - x).norm(), 0, 1e-14);
  }
  EXPECT_TRUE(locator.find({0, 0}));
  EXPECT_TRUE(locator.find({2, 1}));
  EXPECT_FALSE(locator.find({2.1, 0.5}));
  EXPECT_FALSE(locator.find({-1, -1}));
}

TEST(Mesh, crowded_lines_are_symmetric_and_densest_at_the_sides) {
  const auto uniform = graded_lines(-1, 3, 8, 0), crowded = graded_lines(-1, 3, 8, 1);
  for (int i = 0; i <= 8; ++i) {
    EXPECT_NEAR(uniform[i], -1 + 0.5 * i, 1e-14);
    EXPECT_NEAR(crowded[i], 1 - 2 * std::cos(std::numbers::pi * i / 8), 1e-14);
    EXPECT_NEAR(crowded[i] + crowded[8 - i], 2, 1e-14);
  }
}

TEST(Mesh, a_boundary_name_without_outer_edges_is_refused) {
  const Mesh mesh = make_rectangle(uniform_lines(0, 1, 2), uniform_lines(0, 1, 2));
  std::vector<NamedEdge> edges;
  for (const BoundaryEdge& b : mesh.boundary) edges.push_back({mesh.edges[b.edge], b.boundary});
  auto names = mesh.boundary_names;
  EXPECT_NO_THROW(make_mesh(mesh.vertices, mesh.cells, edges, names));
  names.push_back("inside");
  EXPECT_THROW(make_mesh(mesh.vertices, mesh.cells, edges, names), Error);
}

}  // namespace
}  // namespace fpi::fluid
