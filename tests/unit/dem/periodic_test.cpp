/// Grains in a box that repeats itself: what meets through its planes is as what meets in its middle.
#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Periodic, a_box_narrower_than_two_grains_is_refused) {
  Problem problem = glancing(0.05);
  problem.periodic.x = {0, 0.03};
  try {
    make_model(problem);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("periodic.x must be wider than two"), std::string::npos);
  }
}

}  // namespace
}  // namespace fpi::dem
