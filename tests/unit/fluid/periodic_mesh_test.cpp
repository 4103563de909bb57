#include "fluid/mesh/periodic_mesh.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/error.hpp"
#include "fluid/cut/ghost_penalty.hpp"
#include "fluid/measure/profile.hpp"
#include "fluid/mesh/colouring.hpp"
#include "fluid/mesh/locator.hpp"
#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {
namespace {

constexpr std::array<bool, 2> along_x{true, false}, along_both{true, true};

Mesh rectangle(int nx, int ny, const std::array<bool, 2>& periodic,
               std::span<const scene::Refinement> refinements = {}) {
  return make_rectangle(uniform_lines(0, 2, nx), uniform_lines(0, 1, ny), refinements, periodic);
}

scene::Refinement at_corner() {
  scene::Refinement r;
  r.size = 0.02;
  r.box = {1.8, 0.8, 2, 1};
  return r;
}

/// Every node is where its owner is, whole periods away.
void expect_nodes_to_match(const Mesh& mesh) {
  for (Index node = 0; node < mesh.n_nodes(); ++node) {
    EXPECT_EQ(mesh.owner[mesh.owner[node]], mesh.owner[node]);
    const Vec2 apart = mesh.node_position(node) - mesh.node_position(mesh.owner[node]);
    for (int axis : {0, 1}) {
      const double periods = mesh.period.along[axis] ? apart[axis] / mesh.period.length(axis) : 0;
      EXPECT_NEAR(apart[axis], std::round(periods) * mesh.period.length(axis), 1e-14);
    }
  }
}

TEST(Period, wraps_places_and_shifts_what_reaches_over_a_side) {
  const Period period{{1, 0}, {3, 0}, along_x};
  EXPECT_EQ(period.wrapped({2, 7}), Vec2(2, 7));
  EXPECT_EQ(period.wrapped({-8, 7}), Vec2(2, 7));
  EXPECT_EQ(period.wrapped({3, 7}), Vec2(1, 7));
  EXPECT_EQ(period.shifts({1.5, 0}, {2.5, 1}), (std::vector<Vec2>{{0, 0}}));
  EXPECT_EQ(period.shifts({6.5, 0}, {7.5, 1}), (std::vector<Vec2>{{-6, 0}, {-4, 0}}));
  EXPECT_EQ(period.shifts({2.5, 0}, {3, 1}), (std::vector<Vec2>{{-2, 0}, {0, 0}}));
  EXPECT_EQ((Period{{0, 0}, {1, 1}, along_both}.shifts({0.9, 0.9}, {1.1, 1.1})).size(), 4u);
  EXPECT_EQ(Period{}.shifts({-7, -7}, {9, 9}), (std::vector<Vec2>{{0, 0}}));
}

TEST(PeriodicMesh, a_torus_has_no_boundary_and_one_owner_for_each_place) {
  for (const int n : {1, 2, 3, 8}) {
    const Mesh mesh = rectangle(n, n, along_both);
    EXPECT_TRUE(mesh.boundary.empty() && mesh.boundary_names.empty());
    for (Index e = 0; e < mesh.n_edges(); ++e) EXPECT_NE(mesh.edge_cells[e][1], -1);
    expect_nodes_to_match(mesh);
    const std::set<Index> owners(mesh.owner.begin(), mesh.owner.end());
    const auto n_vertices = std::distance(owners.begin(), owners.lower_bound(mesh.n_vertices()));
    const auto n_edges = static_cast<std::ptrdiff_t>(owners.size()) - n_vertices;
    EXPECT_EQ(n_vertices, n * n);
    EXPECT_EQ(n_vertices - n_edges + mesh.n_cells(), 0);  // Euler's formula of a torus
  }
}

TEST(PeriodicMesh, keeps_the_walls_and_their_names) {
  const Mesh mesh = rectangle(6, 4, along_x);
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"bottom", "top"}));
  EXPECT_EQ(mesh.boundary.size(), 12u);
  for (const BoundaryEdge& b : mesh.boundary)
    EXPECT_EQ(mesh.middles[b.edge].y(), b.boundary == 0 ? 0 : 1) << mesh.boundary_names[b.boundary];
}

TEST(PeriodicMesh, refinement_near_a_side_is_the_same_at_the_other) {
  for (const auto& periodic : {along_x, along_both}) {
    const std::vector refinements{at_corner()};
    const Mesh mesh = rectangle(8, 4, periodic, refinements);
    expect_nodes_to_match(mesh);
    double smallest_at_origin = 1;
    for (Index c = 0; c < mesh.n_cells(); ++c)
      for (const Vec2& x : mesh.corners(c))
        if (x == Vec2(0, periodic[1] ? 0 : 1))
          smallest_at_origin = std::min(smallest_at_origin, mesh.size(c));
    EXPECT_LE(smallest_at_origin, 0.05);
    for (Index e = 0; e < mesh.n_edges(); ++e) {
      const auto [one, other] = mesh.edge_cells[e];
      if (other == -1) continue;
      EXPECT_LT(mesh.area(one) / mesh.area(other), 2.01);
    }
  }
  const std::vector refinements{at_corner()};
  EXPECT_THROW(rectangle(2, 4, along_x, refinements), Error);
}

TEST(PeriodicMesh, sides_that_do_not_match_are_refused_with_the_place) {
  const auto refusal = [](Mesh mesh, const Period& period) -> std::string {
    try {
      make_periodic(mesh, period);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  const Mesh open = rectangle(3, 4, {});
  const auto moved = [&](const Vec2& from, const Vec2& to) {
    Mesh mesh = open;
    for (Vec2& x : mesh.vertices)
      if (x == from) x = to;
    return mesh;
  };
  const Period sides{{0, 0}, {2, 1}, along_x};
  EXPECT_EQ(refusal(open, sides), "");
  EXPECT_NE(refusal(moved({2, 0.5}, {2, 0.51}), sides).find("the node at (0, 0.5) m has none at (2, 0.5) m"),
            std::string::npos);
  EXPECT_NE(refusal(moved({2, 0.5}, {1.9, 0.5}), sides).find("has none at (2, 0.25) m"), std::string::npos)
      << refusal(moved({2, 0.5}, {1.9, 0.5}), sides);
  EXPECT_NE(refusal(open, {{0, 0}, {2.5, 1}, along_x}).find("must reach from 0 to 2.5 m"), std::string::npos);
}

/// The penalty over a periodic side is that over the same face inside.
TEST(PeriodicMesh, ghost_faces_across_a_side_are_as_those_inside) {
  const Mesh mesh = rectangle(8, 4, along_x);
  const auto upright_at = [&](double x) {
    for (Index e = 0; e < mesh.n_edges(); ++e)
      if ((mesh.middles[e] - Vec2(x, 0.375)).norm() < 1e-12) return ghost_face(mesh, e);
    throw Error("no such edge");
  };
  const GhostFace inside = upright_at(1), across = upright_at(0), from_beyond = upright_at(2);
  // Inside, either triangle may come first.
  EXPECT_NEAR(across.velocity.trace(), inside.velocity.trace(), 1e-14);
  EXPECT_NEAR(from_beyond.velocity.trace(), inside.velocity.trace(), 1e-14);
  EXPECT_NEAR(across.pressure.norm(), inside.pressure.norm(), 1e-14);
  EXPECT_EQ(std::set<Index>(across.nodes.begin(), across.nodes.end()),
            std::set<Index>(from_beyond.nodes.begin(), from_beyond.nodes.end()));
}

TEST(PeriodicMesh, places_are_found_and_profiles_go_on_any_number_of_periods_away) {
  const Mesh mesh = rectangle(10, 5, along_x);
  const Locator locator(mesh);
  const auto near = locator.find({0.3, 0.4}), far = locator.find({-39.7, 0.4});
  ASSERT_TRUE(near && far);
  EXPECT_EQ(near->cell, far->cell);
  EXPECT_FALSE(locator.find({0.3, 1.4}));
  const auto wave = [&](const Vec2& x) { return std::optional(std::sin(std::numbers::pi * x.x())); };
  const auto profile = measure_profile(mesh, locator, {1.5, 0.5}, {5.5, 0.5}, wave);
  ASSERT_TRUE(profile);
  EXPECT_EQ(profile->points.size(),
            2 * 2 * measure_profile(mesh, locator, {0, 0.5}, {2, 0.5}, wave)->points.size() / 2 - 1);
  EXPECT_NEAR(profile->largest.value, 1, 1e-3);
}

TEST(PeriodicMesh, stripes_of_the_same_kind_share_nothing_around_a_period) {
  const Mesh mesh = make_rectangle(uniform_lines(0, 3, 150), uniform_lines(0, 1, 50), {}, along_both);
  const Colouring colouring = make_colouring(mesh);
  EXPECT_GT(colouring.n, 8);
  std::vector<std::array<std::set<int>, 2>> met(mesh.n_nodes());
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (Index node : mesh.cell_nodes(c)) met[node][colouring.of_cell[c] % 2].insert(colouring.of_cell[c]);
  for (const auto& [even, odd] : met) EXPECT_TRUE(even.size() <= 1 && odd.size() <= 1);
}

}  // namespace
}  // namespace fpi::fluid
