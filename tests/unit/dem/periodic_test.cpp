/// Grains in a box that repeats itself: what meets through its planes is as what meets in its middle.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::step;

constexpr double side = 0.1;  // [m]

/// Spheres on a lattice that fills the box up to its planes, each set going by chance, moved by `shift` [m].
Problem gas(const std::vector<double>& shift) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(-1, 1);
  Problem problem;
  problem.materials = {material(1e6, 0.25, 0.8, 0.4)};
  problem.periodic = {.x = {0, side}, .y = {0, side}, .z = {0, side}};
  constexpr int along = 8;
  for (int k = 0; k < along * along * along; ++k) {
    std::vector<double> x, v;
    for (const int i : {k % along, k / along % along, k / along / along}) {
      x.push_back((i + 0.5 + 0.05 * share(random)) * side / along + shift[x.size()]);
      v.push_back(share(random));
    }
    problem.bodies.push_back(
        body("g" + std::to_string(k), "sphere", 0.0045 + 0.001 * share(random), 2500, x, v));
    problem.bodies.back().spin = {0, 0, 0};
  }
  return problem;
}

Vec3 momentum(const Solver& solver) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < solver.model().bodies.size(); ++i)
    sum += solver.model().bodies.mass[i] * solver.motions().velocity[i];
  return sum;
}

TEST(Periodic, a_search_finds_every_pair_the_shortest_way_around_once) {
  const Problem problem = gas({0.4 * side, 2.3 * side, 0});
  const Model model = make_model(problem);
  const std::vector<Vec3> x = initial_motions(problem).position;
  const Neighbours found = search(model, x, 0);
  std::vector<Pair> pairs, expected;
  each_pair(found, [&](const Pair& pair) { pairs.push_back(pair); });
  std::ranges::sort(pairs);
  for (std::uint32_t a = 0; a < x.size(); ++a)
    for (std::uint32_t b = a + 1; b < x.size(); ++b)
      if (separation(model, x, {a, b}).gap <= found.skin) expected.push_back({a, b});
  EXPECT_EQ(pairs, expected);
}

TEST(Periodic, a_gas_does_not_know_where_the_planes_are) {
  Solver here(gas({0, 0, 0})), there(gas({0.37 * side, -1.61 * side, 5.5 * side}));
  const Vec3 before = momentum(here);
  double largest = 0;
  for (int k = 0; k < 4; ++k) {
    const Advanced outcome = step(here, 2e-3);
    step(there, 2e-3);
    largest = std::max(largest, outcome.largest_overlap);
  }
  ASSERT_GT(largest, 1e-5);
  for (std::size_t i = 0; i < here.motions().velocity.size(); ++i)
    EXPECT_LT((here.motions().velocity[i] - there.motions().velocity[i]).norm(), 1e-7) << i;
  EXPECT_LT((momentum(here) - before).norm(), 1e-13);
}

TEST(Periodic, threads_change_no_bit) {
  std::vector<Vec3> alone;
  const int before = n_threads();
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    Solver solver(gas({0, 0, 0}));
    step(solver, 4e-3);
    if (alone.empty()) alone = solver.motions().position;
    EXPECT_EQ(solver.motions().position, alone) << threads;
  }
  use_threads(before);
}

/// Two discs of which one drops on the other from the side; `x` [m] is where they meet.
Problem glancing(double x) {
  Problem problem;
  problem.materials = {material(1e9, 0.25, 0.7, 0.5)};
  problem.periodic.x = {0, side};
  problem.bodies = {body("a", "disc", 0.01, 2500, {x - 0.0101, 0}, {1, 0.6}),
                    body("b", "disc", 0.01, 2500, {x + 0.0101, 0}, {-1, 0})};
  return problem;
}

TEST(Periodic, discs_hit_each_other_through_a_plane_as_in_the_middle) {
  Solver middle(glancing(0.05)), plane(glancing(0.1)), beyond(glancing(-0.6));
  for (Solver* solver : {&middle, &plane, &beyond}) step(*solver, 4e-3);
  ASSERT_LT(middle.motions().velocity[0].x(), 0);
  for (const Solver* solver : {&plane, &beyond}) {
    for (const int i : {0, 1}) {
      EXPECT_LT((solver->motions().velocity[i] - middle.motions().velocity[i]).norm(), 1e-9);
      EXPECT_LT((solver->motions().spin[i] - middle.motions().spin[i]).norm(), 1e-7);
    }
  }
}

TEST(Periodic, a_contact_through_a_plane_resumes_to_the_same_bits) {
  Problem problem = gas({0, 0, 0});
  Solver solver(problem), resumed(problem);
  step(solver, 4e-3);
  resumed.resume(solver.checkpoint());
  step(solver, 1e-3);
  step(resumed, 1e-3);
  EXPECT_EQ(solver.motions().position, resumed.motions().position);
  EXPECT_EQ(solver.motions().spin, resumed.motions().spin);
}

/// A disc that slides on a floor, of vertices or without end, and around the box.
Problem sliding(const std::vector<double>& vertices) {
  Problem problem;
  problem.gravity = {0, -9.81, 0};
  problem.materials = {material(1e7, 0.25, 0.3, 0)};
  problem.periodic.x = {0, side};
  problem.bodies = {body("a", "disc", 0.01, 2500, {0.05, 0.01}, {1, 0})};
  scene::Wall& floor = problem.walls.emplace_back();
  floor.name = "floor";
  floor.point = {0, 0};
  floor.normal = {0, 1};
  if (!vertices.empty()) floor.shape = "polyline";
  floor.vertices = vertices;
  return problem;
}

TEST(Periodic, a_floor_in_the_box_and_a_grain_beyond_carries_what_goes_around) {
  Solver in_box(sliding({-0.02, 0, side + 0.02, 0})), without_end(sliding({}));
  for (int k = 0; k < 50; ++k) {
    step(in_box, 0.01);
    step(without_end, 0.01);
    EXPECT_LT((in_box.motions().position[0] - without_end.motions().position[0]).norm(), 1e-12);
  }
  EXPECT_NEAR(in_box.motions().position[0].x(), 0.55, 1e-9);
}

std::string refusal(const Problem& problem) {
  try {
    make_model(problem);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Periodic, a_box_narrower_than_two_grains_is_refused) {
  Problem problem = glancing(0.05);
  problem.periodic.x = {0, 0.03};
  EXPECT_NE(refusal(problem).find("periodic.x must be wider than two"), std::string::npos);
}

TEST(Periodic, a_floor_from_plane_to_plane_carries_what_goes_around) {
  Solver in_box(sliding({0, 0, side, 0})), without_end(sliding({}));
  for (int k = 0; k < 50; ++k) {
    step(in_box, 0.01);
    step(without_end, 0.01);
    EXPECT_LT((in_box.motions().position[0] - without_end.motions().position[0]).norm(), 1e-12);
  }
}

/// A disc on a wall of two vertices that ends in the box; both moved by `shift` [m] through it.
Problem at_an_end(double shift) {
  Problem problem = sliding({0.02 + shift, 0, 0.06 + shift, 0.001});
  problem.bodies[0].position = {0.06 + shift, 0.0111};
  problem.bodies[0].velocity = {0, -0.2};
  problem.periodic.x = {shift, shift + side};
  return problem;
}

TEST(Periodic, a_wall_that_ends_meets_grains_through_the_planes_as_in_the_box) {
  Problem through = at_an_end(0);
  through.periodic.x = {0.059, 0.059 + side};  // it lies below the box, and its end in it
  Solver here(at_an_end(0)), there(through);
  for (int k = 0; k < 20; ++k) {
    step(here, 2e-3);
    step(there, 2e-3);
    EXPECT_LT((here.motions().position[0] - there.motions().position[0]).norm(), 1e-12) << k;
  }
  EXPECT_GT(here.motions().position[0].y(), 0.009) << "it fell on the end and stays there";
}

/// Walls and free discs of a box 1 m long, by default two, one of them out of the way.
Problem paddle(bool moves) {
  Problem problem;
  problem.materials = {material(1e8, 0.25, 0.5, 0)};
  problem.periodic.x = {0, 1};
  const double v = moves ? 0 : -1;
  problem.bodies = {body("disc", "disc", 0.05, 1000, {0.5, 0}, {v, 0}),
                    body("far", "disc", 0.05, 1000, {0.5, 3}, {v, 0})};
  scene::Wall& wall = problem.walls.emplace_back();
  wall.name = "paddle";
  wall.shape = "polyline";
  wall.vertices = {0.1, -0.2, 0.1, 0.2};
  if (moves) wall.velocity = {"1", "0"};
  return problem;
}

/// After `steps` steps of `dt` [s] in which the paddle moves with 1 m/s.
double pushed_by_paddle(const Problem& problem, int steps, double dt) {
  Solver solver(problem);
  for (int k = 1; k <= steps; ++k) {
    const Prescribed end{.body = 0, .position = {k * dt, 0, 0}, .velocity = {1, 0, 0}};
    const Advanced outcome = solver.advance(dt, {}, {}, {}, {&end, 1});
    require(outcome.converged, "a step that converges is required: {}", outcome.reason);
    solver.accept();
  }
  return solver.motions().velocity[0].x();
}

TEST(Periodic, a_wall_that_moves_along_the_box_meets_a_grain_again_as_in_its_own_frame) {
  Solver frame(paddle(false));
  for (int k = 0; k < 8; ++k) step(frame, 0.5);
  const double expected = 1 + frame.motions().velocity[0].x();
  EXPECT_NEAR(expected, 0.75, 2e-3) << "hit twice: 1.5 m/s, then 1 − 0.5 · 0.5";
  EXPECT_NEAR(pushed_by_paddle(paddle(true), 400, 0.01), expected, 1e-4);
  EXPECT_NEAR(pushed_by_paddle(paddle(true), 8, 0.5), expected, 1e-4) << "in steps of half the box";
}

scene::Wall polyline(std::vector<double> vertices) {
  scene::Wall wall;
  wall.name = "floor";
  wall.shape = "polyline";
  wall.vertices = std::move(vertices);
  return wall;
}

TEST(Periodic, walls_that_do_not_go_on_in_the_next_box_are_refused_by_name) {
  const auto refused = [](const scene::Wall& wall, const std::string& why) {
    Problem problem = sliding({});
    problem.walls = {wall};
    const std::string text = refusal(problem);
    return text.find("wall floor") != std::string::npos && text.find(why) != std::string::npos;
  };
  EXPECT_TRUE(refused(test::wall("floor", {0, 0}, {0.17, 0.98}), "its normal must have x = 0"));
  EXPECT_TRUE(refused(test::wall("floor", {0, 0}, {1, 0}), "its normal must have x = 0"));
  EXPECT_TRUE(refused(polyline({0, 0, side, 0.01}), "must go on as its own image"));
  EXPECT_TRUE(refused(polyline({-0.01, 0, 0.5 * side, 0.01, side, 0}), "must go on as its own image"));
  scene::Wall arc = polyline({});
  arc.shape = "arc";
  arc.centre = {0.05, 0.1};
  arc.radius = 0.07;
  EXPECT_TRUE(refused(arc, "must go on as its own image"));
  scene::Wall blade = polyline({0.02, 0, 0.08, 0});
  blade.centre = {0.02, 0};
  blade.spin = {"3"};
  EXPECT_TRUE(refused(blade, "must stay within half of periodic.x"));
}

TEST(Periodic, walls_that_go_on_in_the_next_box_or_end_in_it_fit) {
  const auto fits = [](const scene::Wall& wall) {
    Problem problem = sliding({});
    problem.walls = {wall};
    return refusal(problem);
  };
  EXPECT_EQ(fits(test::wall("floor", {0, 0}, {0, 2})), "");
  EXPECT_EQ(fits(polyline({0, 0, side, 0})), "");
  EXPECT_EQ(fits(polyline({-0.3, 0, 0.7, 0})), "") << "longer than the box, and flat";
  EXPECT_EQ(fits(polyline({0, 0, 0.5 * side, 0.01, side, 0})), "") << "both ends are at one height";
  EXPECT_EQ(fits(polyline({0.01, 0, 0.06, 0.04})), "") << "it ends in the box";
  scene::Wall arc = polyline({});
  arc.shape = "arc";
  arc.centre = {0.05, 0.1};
  arc.radius = 0.05;
  EXPECT_EQ(fits(arc), "") << "as wide as the box";
  arc.spin = {"1"};
  EXPECT_EQ(fits(arc), "") << "and turning in its place";
  arc.radius = 0.08;
  arc.start = 0;
  arc.end = 0.5;
  arc.spin = {"0"};
  EXPECT_EQ(fits(arc), "") << "a bit of a circle wider than the box";
  scene::Wall blade = polyline({0.02, 0, 0.08, 0});
  blade.centre = {0.05, 0};
  blade.spin = {"3"};
  EXPECT_EQ(fits(blade), "");
}

/// A tube of triangles about the z axis, its radius going from one to another over a box.
Problem in_tube(double lower_radius, double upper_radius) {
  Problem problem;
  problem.materials = {material(1e7, 0.25, 0.5, 0)};
  problem.periodic.z = {0, side};
  problem.bodies = {body("a", "sphere", 0.01, 2500, {0.02, 0, 0.05}, {0.3, 0, 2})};
  problem.bodies[0].spin = {0, 0, 0};
  scene::Wall& tube = problem.walls.emplace_back();
  tube.name = "tube";
  tube.shape = "mesh";
  tube.file = "tube.stl";
  tube.centre = {0, 0, 0};
  tube.spin = {"0", "0", "1"};
  constexpr int n = 24;
  const auto at = [&](int i, double z) {
    const double angle = 2 * std::numbers::pi * i / n, r = z == 0 ? lower_radius : upper_radius;
    return Vec3(r * std::cos(angle), r * std::sin(angle), z);
  };
  for (int i = 0; i < n; ++i) {
    problem.meshes["tube.stl"].push_back({at(i, 0), at(i + 1, 0), at(i + 1, side)});
    problem.meshes["tube.stl"].push_back({at(i, 0), at(i + 1, side), at(i, side)});
  }
  return problem;
}

TEST(Periodic, a_mesh_that_turns_about_the_periodic_axis_holds_what_goes_around) {
  Solver solver(in_tube(0.05, 0.05));
  for (int k = 0; k < 100; ++k) step(solver, 0.01);
  EXPECT_NEAR(solver.motions().position[0].z(), 0.05 + 2, 1e-6);
  EXPECT_LT(solver.motions().position[0].head<2>().norm(), 0.0401);
  EXPECT_NE(refusal(in_tube(0.05, 0.06)).find("wall tube reaches through the box along periodic.z"),
            std::string::npos);
}

/// Two discs of which one flies away from the other, and around the box: they meet at 0.5 s. `others` far
/// away.
Problem around_the_box(int others) {
  Problem problem;
  problem.materials = {material(1e9, 0.25, 1, 0)};
  problem.periodic.x = {0, 1};
  problem.bodies = {body("a", "disc", 0.1, 1000, {0.2, 0}, {0, 0}),
                    body("b", "disc", 0.1, 1000, {0.5, 0}, {1, 0})};
  for (int k = 0; k < others; ++k)
    problem.bodies.push_back(body("o" + std::to_string(k), "disc", 0.1, 1000,
                                  {k % 2 == 0 ? 0.25 : 0.75, 2 + 0.3 * (k / 2)}, {0, 0}));
  return problem;
}

TEST(Periodic, discs_meet_around_the_box_whatever_the_step) {
  for (const int others : {0, 80})
    for (const double dt : {0.01, 1.0}) {
      Solver solver(around_the_box(others));
      for (double t = 0; t < 1 - 1e-9; t += dt) step(solver, dt);
      EXPECT_NEAR(solver.motions().velocity[0].x(), 1, 1e-6) << others << " " << dt;
      EXPECT_NEAR(solver.motions().position[0].x(), 0.7, 5e-3) << others << " " << dt;
    }
}

TEST(Periodic, many_transits_in_a_step_are_those_of_many_steps) {
  Problem problem = around_the_box(0);
  problem.periodic.y = {-0.5, 0.5};
  problem.bodies[0].velocity = {3, 0};
  problem.bodies[1].velocity = {-2, 0};
  Solver fine(problem), coarse(problem);
  for (int k = 0; k < 1000; ++k) step(fine, 5e-3);
  for (int k = 0; k < 5; ++k) step(coarse, 1);
  for (const int i : {0, 1}) {
    EXPECT_NEAR(coarse.motions().velocity[i].x(), fine.motions().velocity[i].x(), 1e-4);
    EXPECT_NEAR(coarse.motions().position[i].x(), fine.motions().position[i].x(), 5e-3);
  }
  EXPECT_NEAR(coarse.motions().position[0].x() + coarse.motions().position[1].x(), 0.7 + 5, 1e-9);
}

/// A heavy slow disc that rests on a soft one, which makes sub-steps long, while a fast one comes from far
/// away.
TEST(Periodic, a_fast_body_is_met_in_the_long_sub_steps_of_soft_ones) {
  Problem problem;
  problem.materials = {material(1e3, 0.25, 1, 0), material(1e9, 0.25, 1, 0)};
  for (int k = 0; k < 20; ++k) {  // more than are watched pair by pair
    problem.bodies.push_back(body("soft" + std::to_string(k), "disc", 0.1, 1000, {0.1999 * k, 0}, {0, 0}));
  }
  problem.bodies.push_back(body("held", "disc", 0.1, 1000, {9, 5}));
  problem.bodies.back().motion = "fixed";
  problem.bodies.back().material = problem.materials[1].name;
  problem.bodies.push_back(body("fast", "disc", 0.1, 1000, {-40, 5}, {100, 0}));
  problem.bodies.back().material = problem.materials[1].name;
  Solver solver(problem);
  step(solver, 1);
  EXPECT_NEAR(solver.motions().velocity.back().x(), -100, 0.1);
}

}  // namespace
}  // namespace fpi::dem
