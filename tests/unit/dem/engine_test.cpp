/// What the search for neighbours costs and finds, momentum, and threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/parallel.hpp"
#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;

/// Spheres in a cubic lattice with gaps, moved and set going by chance; radii from `smallest` to `largest`
/// [m], most of them small, as a mix by volume has them.
Problem cloud(int along, double smallest, double largest, double speed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  Problem problem;
  problem.materials = {material(1e7, 0.25, 0.6, 0.4)};
  for (int k = 0; k < along * along * along; ++k) {
    const double radius = smallest * std::pow(largest / smallest, std::pow(share(random), 6));
    const auto at = [&](int i) { return 2.05 * largest * i + 0.02 * largest * share(random); };
    const auto v = [&] { return speed * (2 * share(random) - 1); };
    problem.bodies.push_back(body("g" + std::to_string(k), "sphere", radius, 2500,
                                  {at(k % along), at(k / along % along), at(k / along / along)},
                                  {v(), v(), v()}));
    problem.bodies.back().spin = {0, 0, 0};
  }
  return problem;
}

/// The same with small spheres around large ones, near enough to be neighbours.
Problem mix_of_sizes() {
  Problem problem = cloud(4, 0.02, 0.02, 0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 0.164);
  for (int k = 0; k < 6000; ++k)
    problem.bodies.push_back(body("s" + std::to_string(k), "sphere", 0.001, 2500,
                                  {share(random), share(random), share(random)}, {0, 0, 0}));
  return problem;
}

std::vector<Pair> found_pairs(const Neighbours& found) {
  std::vector<Pair> pairs;
  each_pair(found, [&](const Pair& pair) { pairs.push_back(pair); });
  std::ranges::sort(pairs);
  return pairs;
}

TEST(Engine, a_search_in_a_mix_of_1_to_20_finds_every_pair_at_no_quadratic_cost) {
  const Problem problem = mix_of_sizes();
  const Model model = make_model(problem);
  const std::vector<Vec3> x = initial_motions(problem).position;
  const Neighbours found = search(model, x, 0);
  std::vector<Pair> expected;
  for (std::uint32_t a = 0; a < x.size(); ++a) {
    for (std::uint32_t b = a + 1; b < x.size(); ++b) {
      if (separation(model, x, {a, b}).gap <= found.skin) expected.push_back({a, b});
    }
  }
  EXPECT_EQ(found_pairs(found), expected);
  EXPECT_GT(expected.size(), x.size() / 4);
  EXPECT_LT(found.distances, 60 * x.size());
}

TEST(Engine, a_body_far_away_makes_the_search_no_dearer) {
  Problem problem = cloud(12, 5e-4, 6e-4, 0);
  const auto distances = [&] {
    return search(make_model(problem), initial_motions(problem).position, 0).distances;
  };
  const std::uint64_t before = distances();
  problem.bodies[5].position = {1e5, -3e7, 2e3};
  EXPECT_LT(distances(), 2 * before);
}

TEST(Engine, no_pair_reaches_beyond_the_next_slab) {
  const Problem problem = cloud(14, 2e-4, 6e-4, 0);
  const Neighbours found = search(make_model(problem), initial_motions(problem).position, 0);
  ASSERT_GT(found.slabs.size(), 4u);
  const auto slab = [&](std::uint32_t particle) {
    return std::ranges::upper_bound(found.slabs, particle) - found.slabs.begin();
  };
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    for (std::uint32_t p = found.start[i]; p < found.start[i + 1]; ++p)
      ASSERT_LE(slab(found.other[p]) - slab(i), 1);
  }
}

TEST(Engine, any_number_of_threads_gives_bitwise_the_same) {
  std::vector<Motions> ends;
  const int before = n_threads();
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    Solver solver(cloud(12, 4e-4, 6e-4, 0.5));
    const Advanced outcome = test::step(solver, 2e-3);
    EXPECT_GT(outcome.contacts, 10u);
    EXPECT_GT(outcome.searches, 0u);
    ends.push_back(solver.motions());
  }
  use_threads(before);
  EXPECT_TRUE(test::bitwise_equal(ends[0], ends[1]));
  EXPECT_TRUE(test::bitwise_equal(ends[0], ends[2]));
}

/// Momentum [kg m/s] and angular momentum about the origin [kg m²/s].
std::pair<Vec3, Vec3> momenta(const Solver& solver) {
  const Bodies& bodies = solver.model().bodies;
  const Motions& motions = solver.motions();
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vec3 p = bodies.mass[i] * motions.velocity[i];
    linear += p;
    angular += motions.position[i].cross(p) + motions.spin[i] / bodies.inverse_inertia[i];
  }
  return {linear, angular};
}

TEST(Engine, contacts_keep_momentum_and_angular_momentum_to_round_off) {
  Solver solver(cloud(10, 4e-4, 6e-4, 0.5));
  const auto [p, L] = momenta(solver);
  const double mass = 1000 * 1.3e-6, size = 0.012;
  for (int i = 0; i < 5; ++i) ASSERT_GT(test::step(solver, 1e-3).sub_steps, 10u);
  const auto [p_end, L_end] = momenta(solver);
  EXPECT_LT((p_end - p).norm(), 1e-14 * mass * 0.5);
  EXPECT_LT((L_end - L).norm(), 1e-13 * mass * 0.5 * size);
}

}  // namespace
}  // namespace fpi::dem
