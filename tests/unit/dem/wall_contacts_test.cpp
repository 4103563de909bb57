/// Grains on walls of many facets and on walls that move: what the exact surface would do.
#include "dem/contact/wall_contacts.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::bitwise_equal;
using test::body;
using test::material;
using test::on_floor;
using test::step;

constexpr double g = 9.81, R = 0.01;
constexpr double pi = std::numbers::pi;

scene::Wall shaped(const std::string& name, const std::string& shape) {
  scene::Wall wall;
  wall.name = name;
  wall.shape = shape;
  return wall;
}

scene::Wall polyline_wall(std::vector<double> vertices) {
  scene::Wall wall = shaped("wall", "polyline");
  wall.vertices = std::move(vertices);
  return wall;
}

scene::Wall circle(double radius) {
  scene::Wall wall = shaped("drum", "arc");
  wall.centre = {0, 0};
  wall.radius = radius;
  return wall;
}

/// n × n squares of two triangles each over [−size, size]² at y = 0.
std::vector<Corners> floor_mesh(int n, double size) {
  std::vector<Corners> triangles;
  const auto at = [&](int i, int k) { return Vec3(size * (2.0 * i / n - 1), 0, size * (2.0 * k / n - 1)); };
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return triangles;
}

void stand_on_mesh(Problem& problem, std::vector<Corners> triangles) {
  problem.walls = {shaped("mesh", "mesh")};
  problem.walls[0].file = "mesh.stl";
  problem.meshes["mesh.stl"] = std::move(triangles);
}

/// Overlap of a grain at rest under a normal force.
double overlap_under(const Problem& problem, double force) {
  const auto& m = problem.materials[0];
  return std::pow(force / (4.0 / 3 * combine(m, m).normal * std::sqrt(R)), 2.0 / 3);
}

double weight(const Problem& problem) {
  const scene::Body& b = problem.bodies[0];
  return problem.gravity.norm() * b.density * b.volume(R, problem.thickness);
}

/// A sphere that rolls down a slope over a floor of its own material; friction carries two sevenths of what
/// drives it.
Problem rolling(double youngs_modulus = 1e8) {
  Problem problem =
      on_floor(material(youngs_modulus, 0.3, 0.5, 0.4), body("b", "sphere", R, 2500, {0, R, 0}));
  problem.gravity = {g * std::sin(0.2), -g * std::cos(0.2), 0};
  problem.bodies[0].position[1] -= overlap_under(problem, weight(problem) * std::cos(0.2));
  problem.bodies[0].velocity = {0.3, 0, 0.1};
  problem.bodies[0].spin = {0.1 / R, 0, -0.3 / R};
  return problem;
}

TEST(WallContacts, a_sphere_rolls_over_the_joints_of_a_flat_mesh_as_over_a_plane) {
  Problem problem = rolling();
  Solver on_plane(problem);
  stand_on_mesh(problem, floor_mesh(5, 0.1));
  Solver on_mesh(problem);
  for (int i = 0; i < 20; ++i) {
    step(on_plane, 0.01);
    step(on_mesh, 0.01);
    const Motions &a = on_plane.motions(), &b = on_mesh.motions();
    EXPECT_NEAR((a.velocity[0] - b.velocity[0]).norm(), 0, 1e-12) << i;
    EXPECT_NEAR((a.spin[0] - b.spin[0]).norm(), 0, 1e-12 / R) << i;
  }
  EXPECT_GT(on_mesh.motions().position[0].x(), 0.065);
}

TEST(WallContacts, a_disc_rolls_over_the_joints_of_segments_as_over_a_plane) {
  Problem problem = rolling();
  problem.bodies[0] = body("b", "disc", R, 2500, {0, 0.00999}, {0.3, 0});
  Solver on_plane(problem);
  problem.walls = {polyline_wall({-0.1, 0, 0.001, 0, 0.013, 0, 0.0131, 0, 0.06, 0}),
                   polyline_wall({0.06, 0, 0.2, 0})};
  Solver on_segments(problem);
  for (int i = 0; i < 20; ++i) {
    step(on_plane, 0.01);
    step(on_segments, 0.01);
    EXPECT_NEAR((on_plane.motions().velocity[0] - on_segments.motions().velocity[0]).norm(), 0, 1e-12) << i;
  }
  EXPECT_GT(on_segments.motions().position[0].x(), 0.065);
}

TEST(WallContacts, bouncing_on_a_mesh_is_bouncing_on_a_plane) {
  Problem problem =
      on_floor(material(1e7, 0.3, 0.7, 0.3), body("b", "sphere", R, 2500, {0.0037, 0.03, 0.002}));
  problem.bodies[0].velocity = {0.1, 0, 0.05};
  Solver on_plane(problem);
  stand_on_mesh(problem, floor_mesh(5, 0.1));
  Solver on_mesh(problem);
  for (int i = 0; i < 50; ++i) {
    step(on_plane, 0.01);
    step(on_mesh, 0.01);
    EXPECT_NEAR((on_plane.motions().position[0] - on_mesh.motions().position[0]).norm(), 0, 1e-12) << i;
  }
}

TEST(WallContacts, both_slopes_of_a_valley_carry_their_share) {
  const double steep = 0.3, flat = 0.5;  // [rad] of the left and the right slope
  Problem problem = on_floor(material(1e6, 0.3, 0.3), body("b", "disc", R, 2500, {0, 0.0115}));
  problem.walls = {polyline_wall({-std::cos(steep), std::sin(steep), 0, 0, std::cos(flat), std::sin(flat)})};
  Solver solver(problem);
  for (int i = 0; i < 300; ++i) step(solver, 0.01);
  // N_l sin a = N_r sin b and N_l cos a + N_r cos b = W.
  const double W = weight(problem), sum = std::sin(steep + flat);
  const double left = W * std::sin(flat) / sum, right = W * std::sin(steep) / sum;
  const Vec3 x = solver.motions().position[0];
  const Vec3 up_left(std::sin(steep), std::cos(steep), 0), up_right(-std::sin(flat), std::cos(flat), 0);
  EXPECT_NEAR((R - x.dot(up_left)) / overlap_under(problem, left), 1, 1e-3);
  EXPECT_NEAR((R - x.dot(up_right)) / overlap_under(problem, right), 1, 1e-3);
  EXPECT_EQ(solver.advance(0.01, {}).contacts, 2u);
}

TEST(WallContacts, a_disc_at_rest_on_a_ridge_is_carried_by_one_contact) {
  Problem problem = on_floor(material(1e6, 0.3, 0.3), body("b", "disc", R, 2500, {0, 0.0101}));
  problem.walls = {polyline_wall({-1, -1, 0, 0, 1, -1})};
  Solver solver(problem);
  for (int i = 0; i < 300; ++i) step(solver, 0.01);
  EXPECT_NEAR((R - solver.motions().position[0].y()) / overlap_under(problem, weight(problem)), 1, 1e-3);
}

TEST(WallContacts, a_disc_rolls_around_the_end_of_a_segment) {
  Problem problem = on_floor(material(1e8, 0.3, 1, 0), body("b", "disc", R, 2500, {-0.005, 0.01}, {0.1, 0}));
  problem.walls = {polyline_wall({-0.1, 0, 0, 0})};
  Solver solver(problem);
  bool over_end = false;
  for (int i = 0; i < 140; ++i) {
    step(solver, 1e-3);
    const Vec3 x = solver.motions().position[0];
    if (x.x() > 0 && x.y() > 0) over_end = over_end || x.norm() < 1.001 * R;
  }
  EXPECT_TRUE(over_end);
  EXPECT_GT(solver.motions().position[0].x(), 0.011);  // past the end, and no wall beyond it
  EXPECT_LT(solver.motions().position[0].y(), 0.009);
}

TEST(WallContacts, a_disc_that_rolls_in_a_round_bowl_swings_with_the_period_of_theory) {
  const double bowl = 0.1;
  Problem problem = on_floor(material(1e9, 0.3, 1, 10), {});
  problem.walls = {circle(bowl)};
  problem.walls[0].start = -0.75 * pi;
  problem.walls[0].end = -0.25 * pi;
  const double swing = 0.01;  // [rad]; the period grows by swing²/16
  problem.bodies = {body("b", "disc", R, 2500, {0, 0})};
  const double arm = bowl - R + overlap_under(problem, weight(problem));
  problem.bodies[0].position = {arm * std::sin(swing), -arm * std::cos(swing)};
  Solver solver(problem);
  std::vector<double> crossings;
  const double dt = 1e-3;
  for (int i = 0; crossings.size() < 5; ++i) {
    const double before = solver.motions().position[0].x();
    step(solver, dt);
    const double after = solver.motions().position[0].x();
    if (before * after < 0) crossings.push_back(dt * (i + before / (before - after)));
  }
  const double period = 0.5 * (crossings[4] - crossings[0]);
  EXPECT_NEAR(period / (2 * pi * std::sqrt(1.5 * (bowl - R) / g)), 1, 1e-3);
}

/// Where every moving wall of a problem is after `time` at constant velocity and spin about z.
std::vector<Prescribed> walls_at(double time, const Vec3& velocity, double spin) {
  return {{.body = 0,
           .position = time * velocity,
           .orientation = Quaternion(Eigen::AngleAxisd(time * spin, Vec3::UnitZ())),
           .velocity = velocity,
           .spin = {0, 0, spin}}};
}

Advanced step_with_wall(Solver& solver, double from, double dt, const Vec3& velocity, double spin) {
  const Advanced outcome = solver.advance(dt, {}, {}, {}, walls_at(from + dt, velocity, spin));
  EXPECT_TRUE(outcome.converged) << outcome.reason;
  solver.accept();
  return outcome;
}

TEST(WallContacts, a_wall_that_moves_bats_a_ball_away_at_twice_its_speed) {
  Problem problem = on_floor(material(1e8, 0.3), body("b", "sphere", R, 2500, {0, 0.02, 0}));
  problem.gravity.setZero();
  problem.walls[0].velocity = {"0", "0.5", "0"};
  Solver solver(problem);
  for (int i = 0; i < 10; ++i) step_with_wall(solver, 0.01 * i, 0.01, {0, 0.5, 0}, 0);
  EXPECT_NEAR(solver.motions().velocity[0].y(), 1, 1e-4);
}

TEST(WallContacts, an_impact_does_not_depend_on_the_frame_in_which_the_wall_is_at_rest) {
  const auto bounce = [](const Vec3& frame) {
    Problem problem = on_floor(material(1e8, 0.3, 0.6, 0.3), body("b", "disc", R, 2500, {0, 0.0101}));
    problem.gravity.setZero();
    problem.walls = {polyline_wall({-1, 0, 1, 0})};
    problem.walls[0].velocity = {"1", "1"};
    problem.walls[0].centre = {0, 0};
    problem.bodies[0].velocity = {0.2 + frame.x(), -0.5 + frame.y()};
    problem.bodies[0].spin = {30};
    Solver solver(problem);
    for (int i = 0; i < 20; ++i) step_with_wall(solver, 1e-3 * i, 1e-3, frame, 0);
    return std::pair(Vec3(solver.motions().velocity[0] - frame), solver.motions().spin[0].z());
  };
  const auto [at_rest, spin] = bounce({0, 0, 0});
  const auto [moving, moving_spin] = bounce({0.7, 0.3, 0});
  EXPECT_GT(at_rest.y(), 0.29);
  EXPECT_NEAR((at_rest - moving).norm(), 0, 1e-3);
  EXPECT_NEAR(spin, moving_spin, 0.1);
}

TEST(WallContacts, a_disc_in_a_turning_drum_ends_up_rolling_without_slip) {
  const double drum = 0.1, turn = -3;
  Problem problem = on_floor(material(1e9, 0.3, 0.5, 0.5), body("b", "disc", R, 2500, {0, -0.09}));
  problem.walls = {circle(drum)};
  problem.walls[0].spin = {"-3"};
  Solver solver(problem);
  for (int i = 0; i < 200; ++i) {
    step_with_wall(solver, 0.01 * i, 0.01, Vec3::Zero(), turn);
    if (i < 20) continue;
    const Vec3 x = solver.motions().position[0], along = Vec3::UnitZ().cross(x.normalized());
    const double surface = solver.motions().velocity[0].dot(along) + R * solver.motions().spin[0].z();
    EXPECT_NEAR(surface, turn * (x.norm() + R), 1e-4) << i;
  }
}

TEST(WallContacts, a_blade_that_turns_throws_a_disc_with_the_speed_of_its_place) {
  // Twice the speed of the blade where it hits, as a wall that moves along.
  Problem problem = on_floor(material(1e9, 0.3), body("b", "disc", R, 2500, {0.5, 0.02}));
  problem.gravity.setZero();
  problem.walls = {polyline_wall({0, 0, 1, 0})};
  problem.walls[0].centre = {0, 0};
  problem.walls[0].spin = {"0.5"};
  Solver solver(problem);
  for (int i = 0; i < 10; ++i) step_with_wall(solver, 0.01 * i, 0.01, Vec3::Zero(), 0.5);
  EXPECT_NEAR(solver.motions().velocity[0].norm(), 2 * 0.5 * 0.5, 2e-3);
}

TEST(WallContacts, a_step_with_moving_walls_is_bitwise_the_same_after_rollback_and_resume) {
  Problem problem = test::box_of_discs();
  for (scene::Body& b : problem.bodies) b.position[0] -= 0.1, b.position[1] -= 0.12;
  problem.walls = {circle(0.2)};
  problem.walls.push_back(polyline_wall({0.13, 0, 0.2, 0}));
  for (scene::Wall& wall : problem.walls) wall.spin = {"4"}, wall.centre = {0, 0};
  Solver solver(problem);
  const auto walls_after = [](int i) {
    std::vector<Prescribed> walls = walls_at(5e-3 * i, Vec3::Zero(), 4);
    walls.push_back(walls[0]);
    walls[1].body = 1;
    return walls;
  };
  const auto advance = [&](Solver& s, int i) {
    ASSERT_TRUE(s.advance(5e-3, {}, {}, {}, walls_after(i + 1)).converged);
  };
  for (int i = 0; i < 60; ++i) {
    advance(solver, i);
    solver.accept();
  }
  const std::vector<std::uint8_t> bytes = solver.checkpoint();
  Solver resumed(problem);
  resumed.resume(bytes);
  advance(solver, 70);  // another trial in between
  for (int i = 60; i < 70; ++i) {
    advance(solver, i);
    advance(resumed, i);
    solver.accept();
    resumed.accept();
  }
  EXPECT_TRUE(bitwise_equal(solver.motions(), resumed.motions()));
  EXPECT_EQ(solver.checkpoint(), resumed.checkpoint());
}

}  // namespace
}  // namespace fpi::dem
