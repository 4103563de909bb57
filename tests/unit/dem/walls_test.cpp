#include "dem/walls/walls.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace fpi::dem {
namespace {

constexpr double same = 1e-5;

Walls make_wall(std::vector<Facet> facets, bool moves = false) {
  Walls walls;
  walls.add({.name = "wall", .moves = moves}, std::move(facets));
  return walls;
}

/// What a grain at x touches of a wall at rest: every facet nearer than `reach`, less what is not a place of
/// its own.
std::vector<NearFacet> touched(const Walls& walls, const Vec3& x, double reach) {
  std::vector<NearFacet> near;
  const WallMotions motions = at_start(walls);
  for (std::uint32_t f = 0; f < walls.facets.size(); ++f) {
    const Nearest at = nearest(walls, motions, f, x);
    if (at.distance <= reach) near.push_back({f, at});
  }
  keep_own_places(walls, motions, same, near);
  return near;
}

/// The square [−1, 1]² at z = 0 in triangles around its middle.
Walls fan(int n) {
  std::vector<Facet> facets;
  const auto rim = [n](int i) {
    const double angle = 2 * std::numbers::pi * i / n;
    return Vec3(std::cos(angle), std::sin(angle), 0);
  };
  for (int i = 0; i < n; ++i) facets.emplace_back(Triangle({Vec3(0, 0, 0), rim(i), rim(i + 1)}));
  return make_wall(facets);
}

TEST(Walls, a_flat_mesh_is_touched_in_one_place_wherever_the_grain_is) {
  const Walls floor = fan(7);
  for (double x = -0.3; x < 0.3; x += 0.01) {
    for (const double y : {-0.1, -1e-17, 0.0, 1e-9, 0.02}) {
      const auto places = touched(floor, {x, y, 0.19}, 0.2);
      ASSERT_EQ(places.size(), 1u) << x << " " << y;
      EXPECT_NEAR(places[0].at.distance, 0.19, 1e-15);
      EXPECT_NEAR(places[0].at.normal.z(), 1, 1e-14);
    }
  }
}

TEST(Walls, a_ridge_is_touched_in_one_place_with_the_normal_of_its_edge) {
  const Walls ridge = make_wall(polyline(std::vector<double>{-1, -1, 0, 0, 1, -1}, false));
  const auto places = touched(ridge, {0.01, 0.1, 0}, 0.2);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_TRUE(places[0].at.normal.isApprox(Vec3(0.01, 0.1, 0).normalized()));
}

TEST(Walls, a_valley_is_touched_at_both_slopes) {
  const Walls valley = make_wall(polyline(std::vector<double>{-1, 1, 0, 0, 1, 1}, false));
  const auto places = touched(valley, {0, 0.1 * std::sqrt(2), 0}, 0.11);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_NEAR(places[0].at.normal.dot(places[1].at.normal), 0, 1e-15);
}

TEST(Walls, an_end_in_the_middle_of_a_segment_does_not_push_by_itself) {
  std::vector<Facet> facets = polyline(std::vector<double>{-1, 0, 1, 0}, false);
  facets.emplace_back(Segment({0.05, 0, 0}, {0.05, -1, 0}));
  EXPECT_EQ(touched(make_wall(facets), {0, 0.1, 0}, 0.2).size(), 1u);
  EXPECT_EQ(touched(make_wall({facets[1]}), {0, 0.1, 0}, 0.2).size(), 1u);  // alone it does
}

TEST(Walls, a_corner_of_a_mesh_is_touched_once) {
  const Vec3 tip(0, 0, 0), a(1, 0, -1), b(-1, 1, -1), c(-1, -1, -1);
  const Walls tent = make_wall({Triangle({tip, a, b}), Triangle({tip, b, c}), Triangle({tip, c, a})});
  const auto places = touched(tent, {0, 0, 0.1}, 0.2);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_TRUE(places[0].at.normal.isApprox(Vec3(0, 0, 1)));
}

TEST(Walls, both_ends_of_a_bowl_hold_a_disc_too_large_for_it) {
  const Walls bowl = make_wall(arc({0, 0, 0}, 1, std::numbers::pi, 2 * std::numbers::pi));
  for (const double x : {-1e-3, 0.0, 1e-3}) {
    const auto places = touched(bowl, {x, 0.75, 0}, 1.26);
    ASSERT_EQ(places.size(), 2u) << x;
    EXPECT_NEAR(std::abs(places[0].at.place.x()), 1, 1e-15);
    EXPECT_NEAR(places[0].at.place.x() + places[1].at.place.x(), 0, 1e-15);
  }
}

TEST(Walls, a_round_wall_is_touched_in_one_place_at_its_joints_too) {
  const Walls ring = make_wall(arc({0, 0, 0}, 1, 0, 2 * std::numbers::pi));
  for (int i = 0; i < 64; ++i) {
    const double angle = 2 * std::numbers::pi * i / 64;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const auto places = touched(ring, 0.81 * out, 0.2);
    ASSERT_EQ(places.size(), 1u) << i;
    EXPECT_NEAR((places[0].at.normal + out).norm(), 0, 1e-15);
  }
}

TEST(Walls, a_wall_that_moved_is_where_its_motion_says) {
  const Walls blade = make_wall(polyline(std::vector<double>{0, 0, 1, 0}, false), true);
  WallMotions motions = at_start(blade);
  WallMotion& motion = motions[0];
  motion.velocity = {0.5, 0, 0};
  motion.spin = {0, 0, std::numbers::pi};
  for (int i = 0; i < 50; ++i) motion.drift(0.01);  // a quarter of a turn, and 0.25 m along x
  const Nearest found = nearest(blade, motions, 0, {0.5, 0.6, 0});
  EXPECT_NEAR((found.place - Vec3(0.25, 0.6, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((found.normal - Vec3(1, 0, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((motion.velocity_at(found.place) - Vec3(0.5 - 0.6 * std::numbers::pi, 0, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((into_wall(blade.walls[0], motion, {0.25, 0.6, 0}) - Vec3(0.6, 0, 0)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace fpi::dem
