/// What is too soft to stop a body does not turn its force over when the centre comes through: the step is
/// refused, with who, where and what to do.
#include <gtest/gtest.h>

#include <numbers>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;

scene::Wall shaped(const std::string& shape) {
  scene::Wall wall;
  wall.name = "floor";
  wall.shape = shape;
  return wall;
}

scene::Wall polyline() {
  scene::Wall wall = shaped("polyline");
  wall.vertices = {-1, 0, 0.003, 0, 1, 0};
  return wall;
}

/// The upper half of a circle below y = 0.
scene::Wall hill() {
  scene::Wall wall = shaped("arc");
  wall.centre = {0, -1};
  wall.radius = 1;
  wall.start = 0;
  wall.end = std::numbers::pi;
  return wall;
}

/// A disc of 2 cm that falls 1 m on something of the modulus given.
Problem drop(const scene::Wall& wall, double youngs_modulus) {
  Problem problem;
  problem.gravity = {0, -9.81, 0};
  problem.materials = {material(youngs_modulus, 0.25, 0.5)};
  problem.bodies = {body("disc", "disc", 0.01, 2500, {0, 1.01})};
  problem.walls = {wall};
  return problem;
}

/// A sphere of 2 mm that falls 1 m along z on a floor of two triangles.
Problem drop_on_mesh(double youngs_modulus) {
  Problem problem;
  problem.gravity = {0, 0, -9.81};
  problem.materials = {material(youngs_modulus, 0.25, 0.5)};
  problem.bodies = {body("disc", "sphere", 0.001, 2500, {0.3, 0.1, 1.001}, {0, 0, 0})};
  problem.bodies[0].spin = {0, 0, 0};
  problem.walls = {shaped("mesh")};
  problem.walls[0].file = "floor.stl";
  const Vec3 a(-1, -1, 0), b(1, -1, 0), c(1, 1, 0), d(-1, 1, 0);
  problem.meshes["floor.stl"] = {{a, b, c}, {a, c, d}};
  return problem;
}

/// Why the fall ended in steps of 1 ms; empty where it went on to the end.
std::string end_of(const Problem& problem, double time_step = 1e-3) {
  Solver solver(problem);
  for (double t = 0; t < 0.8; t += time_step) {
    const Advanced outcome = solver.advance(time_step, {});
    if (!outcome.converged) return outcome.reason;
    solver.accept();
  }
  return "";
}

void expect_named(const std::string& reason, const std::string& others) {
  EXPECT_NE(
      reason.find("disc and " + others + " overlap by more than a radius: disc would pass through at ("),
      std::string::npos)
      << reason;
  EXPECT_NE(reason.find("larger youngs_modulus"), std::string::npos) << reason;
}

TEST(Passing, a_soft_wall_of_any_shape_stops_the_run_by_name_as_a_plane_does) {
  for (const scene::Wall& wall : {test::wall("floor", {0, 0}, {0, 1}), polyline(), hill()}) {
    expect_named(end_of(drop(wall, 1e6)), "floor");
    expect_named(end_of(drop(wall, 1e2)), "floor");
  }
  expect_named(end_of(drop_on_mesh(1e5)), "floor");
  expect_named(end_of(drop_on_mesh(10)), "floor");
}

TEST(Passing, a_wall_that_is_stiff_enough_throws_it_back) {
  for (const scene::Wall& wall : {polyline(), hill()}) EXPECT_EQ(end_of(drop(wall, 1e9)), "");
  EXPECT_EQ(end_of(drop_on_mesh(1e8)), "");
}

TEST(Passing, a_wall_that_moves_through_a_body_is_seen) {
  Problem problem = drop(polyline(), 1e4);
  problem.gravity.setZero();
  problem.walls[0].velocity = {"0", "10"};
  Solver solver(problem);
  const Prescribed end{.body = 0, .position = {0, 2, 0}, .velocity = {0, 10, 0}};
  const Advanced outcome = solver.advance(0.2, {}, {}, {}, {&end, 1});
  EXPECT_FALSE(outcome.converged);
  expect_named(outcome.reason, "floor");
}

TEST(Passing, a_soft_body_that_another_passes_through_stops_the_run_by_name) {
  for (const double modulus : {1e4, 1.0}) {
    Problem problem = drop(polyline(), modulus);
    problem.walls.clear();
    problem.bodies.push_back(body("held", "disc", 0.01, 2500, {0.001, 0}));
    problem.bodies.back().motion = "fixed";
    expect_named(end_of(problem), "held");
    expect_named(end_of(problem, 0.1), "held");
  }
}

TEST(Passing, the_end_of_a_wall_is_no_surface_to_pass_through) {
  Problem problem = drop(shaped("polyline"), 1e8);
  problem.walls[0].vertices = {0.008, 0, 1, 0};
  EXPECT_EQ(end_of(problem), "");
}

TEST(Passing, a_stop_at_linear_springs_names_their_stiffness) {
  Problem problem = drop(polyline(), 1e6);
  problem.dem.contact = "linear";
  problem.materials[0].normal_stiffness = 100;
  EXPECT_NE(end_of(problem).find("larger normal_stiffness"), std::string::npos);
}

}  // namespace
}  // namespace fpi::dem
