#include "dem/walls/facets.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "dem/walls/facet_grid.hpp"

namespace fpi::dem {
namespace {

constexpr double pi = std::numbers::pi;

const Triangle triangle({Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0)});

std::vector<Facet> one_of_each() {
  return {Plane{Vec3(0.6, 0.8, 0), 0.3}, Segment({0, 0, 0}, {1, 0.5, 0}),
          Arc{{0.5, 0, 0}, Vec3(0, 1, 0), 0.8, 0.6}, triangle};
}

TEST(Facets, a_face_is_nearest_straight_below) {
  const Nearest found = nearest(triangle, {0.5, 0.25, -0.1});
  EXPECT_TRUE(found.on_face);
  EXPECT_EQ(found.normal, Vec3(0, 0, -1));
  EXPECT_DOUBLE_EQ(found.distance, 0.1);
  EXPECT_EQ(found.place, Vec3(0.5, 0.25, 0));
}

TEST(Facets, beyond_its_sides_a_triangle_is_nearest_at_an_edge_or_corner) {
  const auto place = [](const Vec3& x) { return nearest(triangle, x).place; };
  EXPECT_TRUE(place({1, -0.3, 0.2}).isApprox(Vec3(1, 0, 0)));
  EXPECT_TRUE(place({3, -0.1, 0}).isApprox(Vec3(2, 0, 0)));
  EXPECT_TRUE(place(Vec3(1, 0.5, 0) + 0.4 * Vec3(1, 2, 3)).isApprox(Vec3(1, 0.5, 0)));
  EXPECT_FALSE(nearest(triangle, {3, -0.1, 0}).on_face);
}

TEST(Facets, the_nearest_point_of_an_obtuse_triangle_may_be_beyond_two_of_its_edges) {
  const Triangle obtuse({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(-3, 0.1, 0)});
  const Vec3 x(-1, -0.5, 0);
  double least = 1e30;
  for (double s = 0; s <= 1; s += 1e-3) {
    least = std::min(least, (x - s * Vec3(1, 0, 0)).norm());
    least = std::min(least, (x - s * Vec3(-3, 0.1, 0)).norm());
  }
  EXPECT_NEAR(nearest(obtuse, x).distance, least, 1e-4);
}

TEST(Facets, an_arc_has_an_inside_an_outside_and_two_ends) {
  const Arc arc{{1, 0, 0}, Vec3(0, 1, 0), 2, pi / 4};
  EXPECT_TRUE(nearest(arc, {1, 1.5, 0}).place.isApprox(Vec3(1, 2, 0)));
  EXPECT_TRUE(nearest(arc, {1, 1.5, 0}).normal.isApprox(Vec3(0, -1, 0)));
  EXPECT_TRUE(nearest(arc, {1, 2.5, 0}).normal.isApprox(Vec3(0, 1, 0)));
  const Vec3 right = Vec3(1, 0, 0) + std::sqrt(2) * Vec3(1, 1, 0);
  EXPECT_TRUE(nearest(arc, {3, 0, 0}).place.isApprox(right));
  EXPECT_FALSE(nearest(arc, {3, 0, 0}).on_face);
  EXPECT_DOUBLE_EQ(nearest(arc, {1, 0, 0}).distance, 2);  // at the centre any point is the nearest
}

TEST(Facets, an_arc_has_the_smallest_box_around_it) {
  const auto box = [](double start, double end) {
    Box all;
    for (const Facet& facet : arc({1, 2, 0}, 2, start, end)) all.extend(bounds(facet));
    return all;
  };
  EXPECT_TRUE(box(0, pi / 2).isApprox(Box(Vec3(1, 2, 0), Vec3(3, 4, 0)), 1e-14));
  EXPECT_TRUE(
      box(-pi / 4, pi / 4)
          .isApprox(Box(Vec3(1 + std::sqrt(2), 2 - std::sqrt(2), 0), Vec3(3, 2 + std::sqrt(2), 0)), 1e-14));
  EXPECT_TRUE(box(0.3, 0.3 + 2 * pi).isApprox(Box(Vec3(-1, 0, 0), Vec3(3, 4, 0)), 1e-14));
}

TEST(Facets, no_point_of_a_facet_is_nearer_than_the_nearest) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> somewhere(-2, 2);
  for (const Facet& facet : one_of_each()) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 x(somewhere(generator), somewhere(generator), facet.index() == 3 ? somewhere(generator) : 0);
      const Nearest found = nearest(facet, x);
      EXPECT_NEAR((x - found.place - found.distance * found.normal).norm(), 0, 1e-14);
      EXPECT_NEAR(found.normal.norm(), 1, 1e-14);
      // The nearest points of other places are points of the facet.
      const Vec3 y(somewhere(generator), somewhere(generator), 0);
      const Vec3 other = nearest(facet, y).place;
      EXPECT_GE((x - other).norm(), std::abs(found.distance) - 1e-14);
      EXPECT_TRUE(bounds(facet).exteriorDistance(other) < 1e-14);
    }
  }
}

TEST(Facets, pieces_of_an_arc_join_and_end_where_it_does) {
  const std::vector<Facet> pieces = arc({0, 0, 0}, 1, -pi / 2, pi);
  ASSERT_EQ(pieces.size(), 3u);
  const auto end = [&](std::size_t i, double turn) {
    const Arc& piece = std::get<Arc>(pieces[i]);
    return Vec3(Eigen::AngleAxisd(turn * piece.half_span, Vec3::UnitZ()) * piece.middle);
  };
  EXPECT_TRUE(end(0, -1).isApprox(Vec3(0, -1, 0)));
  EXPECT_TRUE(end(0, 1).isApprox(end(1, -1)));
  EXPECT_TRUE(end(1, 1).isApprox(end(2, -1)));
  EXPECT_TRUE(end(2, 1).isApprox(Vec3(-1, 0, 0)));
  EXPECT_EQ(arc({0, 0, 0}, 1, 0, 2 * pi).size(), 4u);
}

TEST(Facets, a_closed_polyline_ends_where_it_began) {
  const std::vector<double> vertices{0, 0, 1, 0, 1, 1};
  EXPECT_EQ(polyline(vertices, false).size(), 2u);
  const std::vector<Facet> closed = polyline(vertices, true);
  ASSERT_EQ(closed.size(), 3u);
  EXPECT_TRUE(nearest(closed[2], {0, 0.9, 0}).place.isApprox(Vec3(0.45, 0.45, 0)));
}

TEST(FacetGrid, finds_what_meets_a_box_and_little_else) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> somewhere(0, 1), near(-0.02, 0.02);
  std::vector<Facet> facets;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a(somewhere(generator), somewhere(generator), somewhere(generator));
    const auto beside = [&] { return Vec3(a + Vec3(near(generator), near(generator), near(generator))); };
    facets.emplace_back(Triangle({a, beside(), beside()}));
  }
  const FacetGrid grid(facets);
  std::vector<std::uint32_t> found;
  std::size_t all = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 x(somewhere(generator), somewhere(generator), somewhere(generator));
    const Box box(x - Vec3::Constant(0.03), x + Vec3::Constant(0.03));
    grid.find(box, found);
    all += found.size();
    EXPECT_TRUE(std::ranges::is_sorted(found));
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
      const bool is_found = std::ranges::binary_search(found, f);
      EXPECT_TRUE(is_found || !bounds(facets[f]).intersects(box)) << f;
    }
  }
  EXPECT_LT(all, 100 * 30u);
  grid.find(Box(Vec3(5, 5, 5), Vec3(6, 6, 6)), found);
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace fpi::dem
