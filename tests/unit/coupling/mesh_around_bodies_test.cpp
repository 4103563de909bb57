/// Refinements that a scene's elements_per_diameter stands for.
#include "coupling/mesh_around_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fpi::coupling {
namespace {

scene::Body disc(double x, double y, double radius, const std::string& motion = "fixed") {
  scene::Body body;
  body.name = "disc";
  body.radius = radius;
  body.density = 2;
  body.position = {x, y};
  body.motion = motion;
  return body;
}

scene::Scene scene_of(std::vector<scene::Body> bodies, double elements_per_diameter = 16) {
  scene::Scene s;
  s.bodies = std::move(bodies);
  s.time.step = 0.05;
  s.time.end = 20;
  s.fluid.emplace();
  s.fluid->density = 1;
  s.fluid->mesh.lower = {0, 0};
  s.fluid->mesh.upper = {10, 20};
  s.fluid->mesh.elements_per_diameter = elements_per_diameter;
  return s;
}

using Box = std::vector<double>;

TEST(MeshAroundBodies, each_fixed_body_gets_triangles_of_its_own_size_on_its_outline) {
  scene::Body square = disc(7, 7, 0);
  square.shape = "polygon";
  square.vertices = {0, 0, 0.5, 0, 0.5, 0.5, 0, 0.5};
  scene::Scene s = scene_of({disc(1, 2, 0.5), disc(4, 5, 0.125), square});
  s.hydraulic_radius_ratio = 0.8;
  const auto found = mesh_around_bodies(s).refinements;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_DOUBLE_EQ(found[0].size, 0.8 / 16);
  EXPECT_EQ(found[0].centre, (Box{1, 2}));
  EXPECT_DOUBLE_EQ(found[0].radius, 0.4);
  EXPECT_DOUBLE_EQ(found[1].size, 0.2 / 16);
  EXPECT_DOUBLE_EQ(found[2].size, std::sqrt(1 / std::numbers::pi) / 16);  // of the disc with area ¼ m²
  EXPECT_EQ(found[2].line, (Box{7, 7, 7.5, 7, 7.5, 7.5, 7, 7.5, 7, 7}));
}

TEST(MeshAroundBodies, nothing_is_refined_where_the_scene_does_not_ask) {
  EXPECT_TRUE(mesh_around_bodies(scene_of({disc(1, 2, 0.5)}, 0)).refinements.empty());
}

TEST(MeshAroundBodies, a_swinging_disc_has_a_place_within_half_a_triangle_and_none_twice) {
  scene::Body body = disc(5, 5, 0.5, "prescribed");
  body.prescribed_velocity = {"2*cos(2*pi*t)", "0"};  // x = 5 + sin(2πt)/π, twenty times
  const auto found = mesh_around_bodies(scene_of({body})).refinements;
  const double h = 1.0 / 16, swing = 1 / std::numbers::pi;
  for (double t = 0; t < 1; t += 0.001) {
    const double x = 5 + swing * std::sin(2 * std::numbers::pi * t);
    double nearest = 1;
    for (const auto& r : found) nearest = std::min(nearest, std::abs(r.centre[0] - x));
    EXPECT_LE(nearest, h);  // a place within h/2 of each sample, and samples no farther apart
  }
  EXPECT_LE(found.size(), 2 * swing / (h / 2) + 2);
}

TEST(MeshAroundBodies, a_blade_that_turns_is_followed_around_once) {
  scene::Body blade = disc(5, 5, 0, "prescribed");
  blade.shape = "polygon";
  blade.vertices = {-1, -0.1, 1, -0.1, 1, 0.1, -1, 0.1};
  blade.prescribed_velocity = {"0", "0"};
  blade.prescribed_spin = "1";
  const auto found = mesh_around_bodies(scene_of({blade}, 4)).refinements;
  const double h = diameter(blade, 1) / 4, around = 2 * std::numbers::pi * std::hypot(1, 0.1);
  EXPECT_GE(found.size(), around / h);
  EXPECT_LE(found.size(), around / (h / 2) + 1);
  for (const auto& r : found) EXPECT_EQ(r.line.size(), 10u);
}

TEST(MeshAroundBodies, what_reaches_over_a_periodic_side_is_refined_at_the_other_too) {
  scene::Scene s = scene_of({disc(9.9, 5, 0.5), disc(5, 5, 0.5)});
  s.periodic.x = {0, 10};
  const auto found = mesh_around_bodies(s).refinements;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].centre, (Box{9.9, 5}));
  EXPECT_NEAR(found[1].centre[0], -0.1, 1e-12);
  s.bodies = {disc(25, 5, 0.5, "prescribed")};  // outside the box, and twice through it
  s.bodies[0].prescribed_velocity = {"1", "0"};
  const auto path = mesh_around_bodies(s).refinements;
  EXPECT_GE(path.size(), 10 / (1.0 / 16));
  EXPECT_LE(path.size(), 11 / (0.5 / 16));
  for (const auto& r : path) EXPECT_LE(std::abs(r.centre[0] - 5), 5.5);
  s.bodies = {disc(0.2, 12, 0.5, "free")};
  s.gravity = {0, -10};
  const auto column = mesh_around_bodies(s).refinements;
  ASSERT_EQ(column.size(), 2u);
  EXPECT_DOUBLE_EQ(column[1].box[0], 9.2);
  EXPECT_DOUBLE_EQ(column[1].box[2], 11.2);
}

TEST(MeshAroundBodies, a_free_body_gets_the_column_that_its_weight_draws_it_through) {
  scene::Scene s = scene_of({disc(5, 12, 0.5, "free")});
  s.gravity = {0, -10};
  EXPECT_EQ(mesh_around_bodies(s).refinements.at(0).box, (Box{4, 0, 6, 13}));
  s.bodies[0].density = 0.5;
  EXPECT_EQ(mesh_around_bodies(s).refinements.at(0).box, (Box{4, 11, 6, 20}));
  s.gravity = {0, 0};
  EXPECT_EQ(mesh_around_bodies(s).refinements.at(0).box, (Box{0, 0, 10, 20}));
  s.fluid->mesh.free_bodies_box = {1, 2, 3, 4};
  const MeshAroundBodies found = mesh_around_bodies(s);
  EXPECT_EQ(found.refinements.at(0).box, (Box{1, 2, 3, 4}));
  EXPECT_NE(found.notes.at(0).find("body \"disc\" is expected, in [1, 3] × [2, 4] m"), std::string::npos);
}

}  // namespace
}  // namespace fpi::coupling
