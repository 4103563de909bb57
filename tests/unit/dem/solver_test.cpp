/// Rollback, checkpoints, the search for neighbours, and requests that are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::bitwise_equal;
using test::body;
using test::box_of_discs;
using test::material;
using test::step;

constexpr double dt = 5e-3;

Solver settled_for(int steps) {
  Solver solver(box_of_discs());
  for (int i = 0; i < steps; ++i) step(solver, dt);
  return solver;
}

TEST(Solver, advance_twice_is_bitwise_the_same) {
  Solver solver = settled_for(20);
  const Load force{.body = 3, .force = {0.1, 0.2, 0}};
  ASSERT_GT(solver.advance(dt, {}).contacts, 5u);
  const Motions first = solver.motions();
  solver.advance(2 * dt, std::span(&force, 1));  // another trial in between
  EXPECT_FALSE(bitwise_equal(solver.motions(), first));
  solver.advance(dt, {});
  EXPECT_TRUE(bitwise_equal(solver.motions(), first));
}

TEST(Solver, restore_is_bitwise) {
  Solver solver = settled_for(20);
  const Motions accepted = solver.motions();
  solver.advance(dt, {});
  EXPECT_FALSE(bitwise_equal(solver.motions(), accepted));
  solver.restore();
  EXPECT_TRUE(bitwise_equal(solver.motions(), accepted));
}

TEST(Solver, grains_pass_through_the_place_of_one_that_left_and_a_resumed_run_goes_on_bitwise_alike) {
  Problem problem = box_of_discs();
  Solver solver(problem);
  for (int i = 0; i < 10; ++i) step(solver, 2e-3);
  ASSERT_TRUE(solver.advance(2e-3, {}).converged);
  solver.accept(std::vector<std::uint32_t>{2});
  const std::vector<std::uint8_t> bytes = solver.checkpoint();
  Solver resumed(problem);
  resumed.resume(bytes);
  EXPECT_EQ(resumed.checkpoint(), bytes);
  const Vec3 where = solver.motions().position[2];
  std::uint32_t touched = 0;
  for (int i = 0; i < 60; ++i) {
    step(solver, 2e-3);
    step(resumed, 2e-3);
    EXPECT_EQ(solver.contacts()[2], 0u);
    for (std::uint32_t other = 3; other < 25; ++other)
      if ((solver.motions().position[other] - where).norm() < solver.model().bodies.radius[2]) ++touched;
  }
  EXPECT_GT(touched, 0u) << "grains pass through the place where it was";
  EXPECT_EQ(solver.motions().position[2], where);
  EXPECT_TRUE(bitwise_equal(solver.motions(), resumed.motions()));
}

TEST(Solver, a_resumed_run_goes_on_bitwise_as_the_one_that_went_on) {
  Solver solver = settled_for(20);
  const std::vector<std::uint8_t> bytes = solver.checkpoint();
  Solver resumed(box_of_discs());
  resumed.resume(bytes);
  EXPECT_EQ(resumed.checkpoint(), bytes);
  for (int i = 0; i < 20; ++i) {
    step(solver, dt);
    step(resumed, dt);
  }
  EXPECT_TRUE(bitwise_equal(solver.motions(), resumed.motions()));
}

TEST(Solver, counts_the_places_that_each_body_touches_others_and_walls_at) {
  Problem problem = test::on_floor(material(2e6, 0.3), body("low", "disc", 0.1, 1000, {0, 0.0999}));
  problem.bodies.push_back(body("high", "disc", 0.1, 1000, {0, 0.2998}));
  problem.bodies.push_back(body("apart", "disc", 0.1, 1000, {1, 0.5}));
  Solver solver(problem);
  solver.advance(1e-5, {});
  EXPECT_EQ(solver.contacts(), (std::vector<std::uint32_t>{2, 1, 0}));
}

TEST(Solver, a_box_of_discs_loses_energy_and_comes_to_rest) {
  Solver solver(box_of_discs());
  const double start = test::energy(solver);
  double last = start, deepest = 0;
  for (int i = 0; i < 15; ++i) {
    for (int k = 0; k < 20; ++k) deepest = std::max(deepest, step(solver, dt).largest_overlap);
    EXPECT_LE(test::energy(solver), last + 1e-6 * start);  // what tangential springs store is not in the sum
    last = test::energy(solver);
  }
  EXPECT_LT(last, 0.5 * start);
  EXPECT_GT(deepest, 0);
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_LT(solver.motions().velocity[i].norm(), 1e-4) << i;
    EXPECT_GT(solver.motions().position[i].y(), 0) << i;
  }
}

TEST(Solver, grains_at_rest_are_not_searched_for_again) {
  Solver solver = settled_for(300);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(step(solver, dt).searches, 0u);
}

TEST(Solver, a_search_finds_the_pairs_that_all_pairs_would) {
  const Solver solver = settled_for(50);
  const auto& x = solver.motions().position;
  const Neighbours found = search(solver.model(), x, 0);
  std::vector<Pair> places;
  each_pair(found, [&](const Pair& pair) { places.push_back(pair); });
  std::ranges::sort(places);
  std::vector<Pair> expected;
  for (std::uint32_t a = 0; a < x.size(); ++a) {
    for (std::uint32_t b = a + 1; b < x.size(); ++b) {
      if (separation(solver.model(), x, {a, b}).gap <= found.skin) expected.push_back({a, b});
    }
  }
  EXPECT_EQ(places, expected);
  EXPECT_LT(places.size(), x.size() * x.size() / 4);
}

TEST(Solver, the_whole_weight_acts) {
  Problem problem = box_of_discs();
  problem.walls.clear();
  Solver solver(problem);
  step(solver, 1e-3);
  EXPECT_NEAR(solver.motions().velocity[7].y(), -9.81e-3, 1e-15);
}

TEST(Solver, a_body_pushed_through_a_wall_does_not_converge_and_is_named) {
  Solver solver(
      test::on_floor(material(1e3, 0.3), body("lead", "sphere", 0.01, 11000, {0, 0.02, 0}, {0, -50, 0})));
  const Advanced outcome = solver.advance(1e-2, {});
  EXPECT_FALSE(outcome.converged);
  EXPECT_NE(outcome.reason.find("lead and floor overlap"), std::string::npos) << outcome.reason;
}

TEST(Solver, a_body_that_is_not_finite_does_not_converge_and_is_named) {
  Solver solver(test::on_floor(material(1e6, 0.3), body("mote", "sphere", 0.01, 1, {0, 1, 0})));
  const Load load{.body = 0, .force = {1e308, 0, 0}};
  const Advanced outcome = solver.advance(1, std::span(&load, 1));
  EXPECT_FALSE(outcome.converged);
  EXPECT_NE(outcome.reason.find("mote"), std::string::npos) << outcome.reason;
}

TEST(Solver, a_body_too_fast_for_any_step_does_not_hang) {
  Solver solver(box_of_discs());
  const Load load{.body = 4, .force = {1e308, 0, 0}};
  const Advanced outcome = solver.advance(1, std::span(&load, 1));
  EXPECT_FALSE(outcome.converged);
  EXPECT_NE(outcome.reason.find("sub-steps"), std::string::npos) << outcome.reason;
}

/// The sentence of the Error that `action` throws; "" where it throws none.
template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

std::string refusal(const Problem& problem) {
  return complaint([&] { Solver{problem}; });
}

TEST(Solver, refuses_set_ups_that_cannot_be_run) {
  const auto changed = [](auto change) {
    Problem problem = box_of_discs();
    change(problem);
    return refusal(problem);
  };
  EXPECT_EQ(changed([](Problem&) {}), "");
  EXPECT_NE(changed([](Problem& s) { s.bodies[3].density = -1; }).find("free body disc3 must have a mass"),
            std::string::npos);
  EXPECT_NE(changed([](Problem& s) { s.bodies[4].position = s.bodies[3].position; }).find("disc3 and disc4"),
            std::string::npos);
  EXPECT_NE(changed([](Problem& s) { s.bodies[0].position[1] = -0.5; }).find("disc0 and floor"),
            std::string::npos);
  EXPECT_NE(changed([](Problem& s) {
              s.bodies[2].velocity = {0, NAN};
            }).find("disc2 must start with a finite"),
            std::string::npos);
  EXPECT_NE(changed([](Problem& s) { s.bodies[2].shape = "sphere"; }).find("disc2 must be a disc"),
            std::string::npos);
  EXPECT_NE(changed([](Problem& s) {
              s.bodies[2].velocity = {0, 0, 1};
            }).find("plane z = 0"),
            std::string::npos);
  EXPECT_NE(changed([](Problem& s) { s.bodies[2].material = "steel"; }).find("\"steel\""), std::string::npos);
  EXPECT_NE(changed([](Problem& s) { s.materials.clear(); }).find("material for body disc0"),
            std::string::npos);
  EXPECT_NE(changed([](Problem& s) { s.walls[0].normal = {0, 0}; }).find("wall floor"), std::string::npos);
  EXPECT_NE(changed([](Problem& s) { s.bodies.clear(); }).find("must have a body"), std::string::npos);
}

TEST(Solver, bodies_may_overlap_each_other_and_walls_at_the_start_as_far_as_the_scene_says) {
  const auto refused = [](double overlap, double allowed, bool wall) {
    Problem problem = test::on_floor(material(1e8, 0.3), body("small", "sphere", 0.01, 2500, {0, 0.02, 0}));
    problem.bodies.push_back(body("large", "sphere", 0.05, 2500, {0.06 - 0.01 * overlap, 0.5, 0}));
    problem.bodies[0].position[1] = wall ? 0.01 - 0.01 * overlap : 0.5;
    if (wall) problem.bodies.pop_back();
    problem.dem.start_overlap = allowed;
    return refusal(problem);
  };
  EXPECT_EQ(refused(0.009, 0.01, false), "");
  EXPECT_EQ(refused(0.009, 0.01, true), "");
  EXPECT_NE(refused(0.011, 0.01, false).find("small and large must not overlap"), std::string::npos);
  EXPECT_NE(refused(0.011, 0.01, true).find("small and floor must not overlap"), std::string::npos);
  EXPECT_EQ(refused(0.011, 0.02, false), "");
}

TEST(Solver, a_limit_of_the_sub_step_beyond_what_a_contact_allows_changes_nothing) {
  Problem problem = test::on_floor(material(1e9, 0.3), body("b", "sphere", 0.01, 2500, {0, 0.0101, 0}));
  problem.bodies[0].velocity = {0, -1, 0};
  Solver free(problem);
  problem.dem.largest_sub_step = 0.1;
  Solver limited(problem);
  const Advanced unlimited = step(free, 0.01);
  EXPECT_EQ(step(limited, 0.01).sub_steps, unlimited.sub_steps);
  EXPECT_GT(unlimited.sub_steps, 50u);
  EXPECT_TRUE(bitwise_equal(free.motions(), limited.motions()));
}

TEST(Solver, a_body_that_is_lost_is_named_with_place_and_time) {
  Problem problem =
      test::on_floor(material(1e8, 0.3), body("ball", "sphere", 0.01, 2500, {0, 0.5, 0}, {3, 0, 0}));
  problem.dem.lost_distance = 0.1;
  Solver solver(problem);
  step(solver, 0.03);
  EXPECT_EQ(complaint([&] { solver.check_none_lost(0.03); }), "") << "0.1 m beyond its place at the start";
  step(solver, 0.01);
  EXPECT_EQ(
      complaint([&] { solver.check_none_lost(0.04); }),
      "free bodies must stay between (-0.11, -0.1, -0.11) and (0.11, 0.61, 0.11) m; ball is lost: it is at "
      "(0.12, 0.4922, 0) m at t = 0.04 s. Close the walls that it left through, or let it go farther by "
      "dem.lost_distance");
}

TEST(Solver, a_body_is_not_lost_within_a_thousand_diagonals_of_the_scene) {
  Problem problem =
      test::on_floor(material(1e8, 0.3), body("ball", "sphere", 0.01, 2500, {0, 0.5, 0}, {10, 0, 0}));
  problem.gravity.setZero();
  Solver solver(problem);
  step(solver, 50);
  EXPECT_EQ(complaint([&] { solver.check_none_lost(50); }), "");
  step(solver, 2);
  EXPECT_NE(complaint([&] { solver.check_none_lost(52); }).find("ball is lost"), std::string::npos);
}

TEST(Solver, what_falls_freely_for_the_whole_run_is_not_lost) {
  Problem problem;
  problem.gravity = {0, 0, -9.81};
  problem.bodies = {body("grain", "sphere", 5e-4, 2500, {0, 0, 0}, {0, 0, -3})};
  problem.bodies[0].spin = {0, 0, 0};
  problem.duration = 1;
  Solver solver(problem);
  for (int k = 0; k < 100; ++k) {
    step(solver, 1e-2);
    ASSERT_EQ(complaint([&] { solver.check_none_lost(0.01 * k); }), "");
  }
  EXPECT_NEAR(solver.motions().position[0].z(), -3 - 0.5 * 9.81, 1e-12);
  step(solver, 2);
  EXPECT_NE(complaint([&] { solver.check_none_lost(3); }).find("grain is lost"), std::string::npos)
      << "farther than it could fall";
}

TEST(Solver, refuses_steps_that_cannot_be_taken) {
  Solver solver(box_of_discs());
  const auto asked = [&](double time_step, Load load) {
    return complaint([&] { solver.advance(time_step, std::span(&load, 1)); });
  };
  EXPECT_NE(asked(0, {}).find("time_step > 0"), std::string::npos);
  EXPECT_NE(asked(NAN, {}).find("time_step > 0"), std::string::npos);
  EXPECT_NE(asked(1, {.body = 25}).find("25"), std::string::npos);
  EXPECT_NE(asked(1, {.body = 1, .force = {INFINITY, 0, 0}}).find("disc1"), std::string::npos);
  const Prescribed motion{.body = 5};
  EXPECT_NE(complaint([&] { solver.advance(1, {}, std::span(&motion, 1)); }).find("disc5 is free"),
            std::string::npos);
}

TEST(Solver, refuses_a_step_of_too_many_sub_steps) {
  Solver solver(test::on_floor(material(1e12, 0.3), body("grain", "sphere", 1e-6, 2500, {0, 1e-6, 0})));
  const Advanced outcome = solver.advance(1e6, {});
  EXPECT_FALSE(outcome.converged);
  EXPECT_NE(outcome.reason.find("sub-steps"), std::string::npos) << outcome.reason;
}

TEST(Solver, refuses_damaged_state) {
  Solver solver = settled_for(20);
  const std::vector<std::uint8_t> good = solver.checkpoint();
  const auto refused = [&](auto change) {
    std::vector<std::uint8_t> bytes = good;
    change(bytes);
    return complaint([&] { solver.resume(bytes); });
  };
  const auto put = [](std::vector<std::uint8_t>& bytes, std::size_t at, auto value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  };
  EXPECT_EQ(refused([](auto&) {}), "");
  EXPECT_NE(refused([](auto& b) { b.clear(); }), "");
  EXPECT_NE(refused([](auto& b) { b.pop_back(); }), "");
  EXPECT_NE(refused([](auto& b) { b.push_back(0); }), "");
  EXPECT_NE(refused([](auto& b) { b[0] ^= 1; }), "");
  EXPECT_NE(refused([&](auto& b) { put(b, 8, std::uint64_t{24}); }), "");
  EXPECT_NE(refused([&](auto& b) { put(b, 16, ~std::uint64_t{0}); }), "");
  EXPECT_NE(refused([&](auto& b) { put(b, 40, std::uint64_t{7}); }), "") << "loads";
  EXPECT_NE(refused([&](auto& b) { put(b, 48, std::uint64_t{1}); }), "") << "a body that left";
  EXPECT_NE(refused([&](auto& b) { put(b, 56, double{NAN}); }), "");
  EXPECT_NE(refused([&](auto& b) { put(b, 72, 1.0); }), "") << "z of a disc";
  EXPECT_NE(refused([&](auto& b) { put(b, 80, 2.0); }), "") << "w of a quaternion";
  EXPECT_NE(refused([&](auto& b) { put(b, 56 + (25 * 13 + 3 * 10 + 7 + 5) * 8, std::uint32_t{900}); }), "")
      << "a contact";
}

TEST(Solver, a_body_leaves_once_and_must_be_free) {
  Problem problem = box_of_discs();
  problem.bodies[3].motion = "fixed";
  Solver solver(problem);
  const auto leave = [&](std::uint32_t body) {
    return complaint([&] {
      solver.advance(1e-4, {});
      solver.accept(std::vector{body});
    });
  };
  EXPECT_EQ(leave(5), "");
  EXPECT_NE(leave(5).find("must be free and there; disc5"), std::string::npos);
  EXPECT_NE(leave(3).find("must be free and there; disc3"), std::string::npos);
  EXPECT_NE(leave(99).find("25 bodies"), std::string::npos);
}

}  // namespace
}  // namespace fpi::dem
