/// All arithmetic of time.
#include "coupling/time_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace fpi::coupling {
namespace {

scene::Time of(double step, double end, std::int64_t halvings = 6) {
  scene::Time time;
  time.step = step;
  time.end = end;
  time.max_halvings = halvings;
  return time;
}

struct Walk {
  std::vector<double> outputs, steps;
};
Walk walk(TimeWindow& window) {
  Walk walk;
  while (!window.done()) {
    walk.steps.push_back(window.step());
    if (window.ends_at_output()) walk.outputs.push_back(window.end());
    window.accept();
  }
  return walk;
}

TEST(TimeWindow, hits_the_end_to_the_bit) {
  for (const double step : {0.1, 0.003, 0.7, 1e-4, 3.0}) {
    TimeWindow window(of(step, 1.1), 0);
    const Walk walked = walk(window);
    EXPECT_EQ(window.start(), 1.1) << step;
    EXPECT_EQ(walked.outputs, std::vector<double>{1.1});
  }
}

TEST(TimeWindow, hits_output_times_to_the_bit) {
  TimeWindow window(of(0.04, 1), 0.1);
  const std::vector<double> outputs = walk(window).outputs;
  ASSERT_EQ(outputs.size(), 10u);
  for (int k = 1; k < 10; ++k) EXPECT_EQ(outputs[static_cast<std::size_t>(k) - 1], k * 0.1);
  EXPECT_EQ(outputs.back(), 1);
}

TEST(TimeWindow, an_end_between_output_times_is_an_output_time) {
  TimeWindow window(of(0.05, 0.25), 0.1);
  EXPECT_EQ(walk(window).outputs, (std::vector<double>{0.1, 0.2, 0.25}));
}

TEST(TimeWindow, a_step_that_divides_the_way_keeps_its_bits) {
  for (const double interval : {0.0, 0.03, 0.1}) {
    TimeWindow window(of(0.01, 3), interval);
    const Walk walked = walk(window);
    EXPECT_EQ(walked.steps.size(), 300u);
    EXPECT_EQ(std::set(walked.steps.begin(), walked.steps.end()), std::set{0.01});
  }
}

TEST(TimeWindow, takes_no_tiny_step_before_a_target) {
  TimeWindow window(of(0.3, 1), 0);
  const Walk walked = walk(window);
  EXPECT_EQ(walked.steps, (std::vector<double>{0.25, 0.25, 0.25, 0.25}));
}

TEST(TimeWindow, halving_halves_the_step_that_failed) {
  TimeWindow window(of(1, 0.25), 0);
  EXPECT_EQ(window.step(), 0.25);
  EXPECT_TRUE(window.halve());
  EXPECT_EQ(window.step(), 0.125);
  EXPECT_EQ(window.start(), 0);
}

TEST(TimeWindow, halves_as_often_as_allowed) {
  TimeWindow window(of(0.5, 1, 2), 0);
  EXPECT_TRUE(window.halve());
  EXPECT_TRUE(window.halve());
  EXPECT_FALSE(window.halve());
  EXPECT_EQ(window.step(), 0.125);
}

TEST(TimeWindow, a_halved_step_regrows_after_successes_and_still_hits_the_end) {
  TimeWindow window(of(0.1, 2), 0.5);
  window.accept();
  window.halve();
  window.halve();
  EXPECT_LE(window.step(), 0.025);
  const Walk walked = walk(window);
  EXPECT_EQ(window.start(), 2);
  EXPECT_EQ(walked.outputs, (std::vector<double>{0.5, 1, 1.5, 2}));
  EXPECT_DOUBLE_EQ(walked.steps.back(), 0.1);
  for (int k = 0; k < TimeWindow::successes_to_regrow; ++k) {
    EXPECT_LE(walked.steps[static_cast<std::size_t>(k)], 0.025);
  }
  EXPECT_GE(*std::ranges::min_element(walked.steps), 0.0125);
}

TEST(TimeWindow, halvings_are_allowed_again_after_regrowth) {
  TimeWindow window(of(0.1, 10, 1), 0);
  EXPECT_TRUE(window.halve());
  EXPECT_FALSE(window.halve());
  for (int k = 0; k < TimeWindow::successes_to_regrow; ++k) window.accept();
  EXPECT_TRUE(window.halve());
}

TEST(TimeWindow, repeated_halving_and_regrowth_does_not_let_the_step_drift) {
  TimeWindow window(of(0.1, 9.99), 0);
  for (int round = 0; round < 10; ++round) {
    window.halve();
    EXPECT_NEAR(window.step(), 0.05, 0.0005);
    for (int k = 0; k < TimeWindow::successes_to_regrow; ++k) window.accept();
  }
}

scene::Time adaptive(double tolerance, double first, double end, double smallest = 0, double largest = 0) {
  scene::Time time = of(first, end);
  time.relative_tolerance = tolerance;
  time.min_step = smallest;
  time.max_step = largest;
  return time;
}

/// Of a step, where the tolerance is 1e-3.
std::vector<Demand> error(double value, double order) {
  return {{.what = "error", .excess = value / 1e-3, .order = order}};
}

struct Marched {
  std::vector<double> starts, steps;
  std::size_t repeats = 0;
};
/// Steps whose error is stiffness(t) Δt³.
template <class Stiffness>
Marched march(TimeWindow& window, Stiffness stiffness) {
  Marched marched;
  while (!window.done()) {
    const double step = window.step();
    const std::vector<Demand> demands = error(stiffness(window.start()) * step * step * step, 3);
    if (window.judge(demands) == Verdict::repeat) {
      ++marched.repeats;
      EXPECT_LT(window.step(), step);
      continue;
    }
    marched.starts.push_back(window.start());
    marched.steps.push_back(step);
    window.accept(demands);
  }
  return marched;
}

TEST(AdaptiveSteps, go_to_the_size_that_the_tolerance_asks_for_and_stay) {
  TimeWindow window(adaptive(1e-3, 1e-3, 10), 0);
  const Marched marched = march(window, [](double) { return 1.0; });  // error = tolerance at 0.1
  EXPECT_EQ(window.start(), 10);
  EXPECT_EQ(marched.repeats, 0u);
  const std::vector<double> last(marched.steps.end() - 50, marched.steps.end());
  EXPECT_EQ(std::set(last.begin(), last.end()).size(), 1u);
  EXPECT_GT(last[0], 0.09 / 1.2);
  EXPECT_LT(last[0], 0.1);
  for (std::size_t k = 1; k < marched.steps.size(); ++k)
    EXPECT_LE(marched.steps[k], 2 * marched.steps[k - 1] * (1 + 1e-12));
}

TEST(AdaptiveSteps, follow_a_signal_that_is_stiff_first_and_slow_then) {
  TimeWindow window(adaptive(1e-3, 0.1, 20), 0);
  const auto stiffness = [](double t) { return 1 + 1e6 * std::exp(-4 * t); };
  const Marched marched = march(window, stiffness);
  EXPECT_GT(marched.repeats, 0u);
  for (std::size_t k = 0; k < marched.steps.size(); ++k) {
    const double error = stiffness(marched.starts[k]) * std::pow(marched.steps[k], 3);
    EXPECT_LE(error, 2e-3);
    if (marched.starts[k] > 0.5 && marched.starts[k] < 19) {
      EXPECT_GT(error, 1e-3 / 16) << marched.starts[k];
    }
  }
  EXPECT_LT(marched.steps.front(), 0.002);
  EXPECT_GT(marched.steps.back(), 0.07);
}

TEST(AdaptiveSteps, hit_output_times_and_the_end_to_the_bit) {
  TimeWindow window(adaptive(1e-3, 0.01, 1), 0.1);
  std::vector<double> outputs;
  while (!window.done()) {
    const std::vector<Demand> demands = error(3 * std::pow(window.step(), 2), 2);
    if (window.judge(demands) == Verdict::repeat) continue;
    if (window.ends_at_output()) outputs.push_back(window.end());
    window.accept(demands);
  }
  ASSERT_EQ(outputs.size(), 10u);
  for (int k = 1; k < 10; ++k) EXPECT_EQ(outputs[static_cast<std::size_t>(k) - 1], k * 0.1);
  EXPECT_EQ(outputs.back(), 1);
}

TEST(AdaptiveSteps, stay_between_the_smallest_and_the_largest) {
  TimeWindow window(adaptive(1e-3, 0.05, 2, 0.01, 0.08), 0);
  EXPECT_EQ(window.judge(error(1, 3)), Verdict::repeat);
  EXPECT_NEAR(window.step(), 0.01, 1e-12);
  EXPECT_EQ(window.judge(error(1, 3)), Verdict::take_at_smallest);
  window.accept(error(1, 3));
  EXPECT_NEAR(window.step(), 0.01, 1e-4);
  for (int k = 0; k < 8; ++k) window.accept(error(1e-9, 3));
  EXPECT_LE(window.step(), 0.08);
  EXPECT_GT(window.step(), 0.07);
}

TEST(AdaptiveSteps, an_error_up_to_twice_the_tolerance_is_taken_and_the_next_step_smaller) {
  TimeWindow window(adaptive(1e-3, 0.1, 10), 0);
  EXPECT_EQ(window.judge(error(1.9e-3, 3)), Verdict::take);
  window.accept(error(1.9e-3, 3));
  EXPECT_LT(window.step(), 0.08);
  EXPECT_EQ(window.judge(error(2.1e-3, 3)), Verdict::repeat);
}

TEST(AdaptiveSteps, keep_their_size_where_nothing_is_demanded) {
  TimeWindow silent(adaptive(1e-3, 0.1, 1), 0);
  EXPECT_EQ(silent.judge({}), Verdict::take);
  silent.accept({});
  EXPECT_EQ(silent.step(), 0.1);
}

TEST(AdaptiveSteps, follow_the_demand_that_asks_for_the_smallest_step) {
  TimeWindow window(adaptive(1e-3, 0.1, 10), 0);
  window.accept(std::vector<Demand>{{.what = "error", .excess = 0.1, .order = 3},
                                    {.what = "way", .excess = 2, .order = 1},
                                    {.what = "sub-iterations", .excess = 0.5, .order = 1}});
  EXPECT_NEAR(window.step(), 0.045, 1e-3);
}

TEST(AdaptiveSteps, keep_the_way_of_a_body_within_what_is_allowed_and_do_not_outgrow_the_step_given) {
  scene::Time time = of(0.1, 20);
  time.max_displacement = 0.4;
  TimeWindow window(time, 0);
  std::size_t steps = 0;
  for (; !window.done(); ++steps) {
    const double speed = 1 + 9 * std::pow(std::sin(window.start()), 2), way = speed * window.step();
    const std::vector<Demand> demands{{.what = "way", .excess = way / 0.4, .order = 1, .most = 1}};
    if (window.judge(demands) == Verdict::repeat) continue;
    EXPECT_LE(way, 0.4);
    EXPECT_LE(window.step(), 0.1);
    window.accept(demands);
  }
  EXPECT_EQ(window.start(), 20);
  EXPECT_LT(steps, 600u);  // 275 at least, each as long as its way allows
}

TEST(AdaptiveSteps, a_step_that_does_not_converge_is_halved_and_grows_back_only_after_successes) {
  TimeWindow window(adaptive(1e-3, 0.1, 10), 0);
  EXPECT_TRUE(window.halve());
  const double halved = window.step();
  EXPECT_NEAR(halved, 0.05, 1e-3);
  for (int k = 1; k < TimeWindow::successes_to_regrow; ++k) {
    window.accept(error(1e-6, 3));
    EXPECT_EQ(window.step(), halved);
  }
  window.accept(error(1e-6, 3));
  EXPECT_GT(window.step(), 1.5 * halved);
}

TEST(AdaptiveSteps, an_error_of_zero_lets_a_halved_step_grow_and_go_on_growing) {
  TimeWindow window(adaptive(1e-3, 0.1, 10, 0, 0.3), 0);
  window.halve();
  for (int k = 0; k < TimeWindow::successes_to_regrow; ++k) window.accept(error(0, 3));
  EXPECT_NEAR(window.step(), 0.1, 1e-3);
  for (int k = 0; k < 2; ++k) window.accept(error(0, 3));
  EXPECT_NEAR(window.step(), 0.3, 0.02);
}

TEST(AdaptiveSteps, without_an_error_a_halved_step_grows_back_to_the_given_one) {
  TimeWindow window(adaptive(1e-3, 0.1, 9.99), 0);
  for (int k = 0; k < 2; ++k) window.halve();
  EXPECT_NEAR(window.step(), 0.025, 1e-3);
  for (int k = 0; k < 3 * TimeWindow::successes_to_regrow; ++k) window.accept();
  EXPECT_NEAR(window.step(), 0.1, 1e-3);
}

TEST(AdaptiveSteps, a_sudden_start_begins_with_short_steps_and_grows_to_what_its_errors_allow) {
  scene::Time time = of(0.02, 1);
  time.relative_tolerance = 1e-3;
  TimeWindow window(time, 0);
  window.start_suddenly();
  const double first = window.step();
  EXPECT_NEAR(first, 0.02 / 64, 0.02 * first);
  window.accept();
  window.accept();
  EXPECT_EQ(window.step(), first);  // no error is known yet
  for (int k = 0; k < 5; ++k) window.accept(std::array{Demand{.what = "error", .excess = 1e-9, .order = 3}});
  EXPECT_NEAR(window.step(), 32 * first, 0.1 * 32 * first);
}

TEST(AdaptiveSteps, a_sudden_start_leaves_steps_alone_whose_errors_are_not_bounded) {
  TimeWindow window(of(0.02, 1), 0);
  window.start_suddenly();
  EXPECT_EQ(window.step(), 0.02);
}

TEST(AdaptiveSteps, the_step_and_the_smallest_one_may_be_beyond_the_end) {
  TimeWindow window(adaptive(1e-3, 10, 1, 1.5), 0);
  EXPECT_EQ(window.step(), 1);
  window.accept(error(1e-9, 3));
  EXPECT_TRUE(window.done());
  EXPECT_EQ(window.state().front(), 2) << "the step in force, twice the last one";
}

TEST(AdaptiveSteps, state_continues_to_the_bit) {
  TimeWindow window(adaptive(1e-3, 0.01, 5), 0.7), other = window;
  const auto stiffness = [](double t) { return 1 + 50 * std::sin(t) * std::sin(t); };
  for (int k = 0; k < 20; ++k)
    window.accept(error(stiffness(window.start()) * std::pow(window.step(), 3), 3));
  other.set_state(window.state());
  EXPECT_EQ(march(window, stiffness).steps, march(other, stiffness).steps);
}

TEST(TimeWindow, counts_the_steps_that_are_left) {
  TimeWindow window(of(0.1, 1), 0.3);
  EXPECT_EQ(window.steps_left(), 10);
  window.accept();
  EXPECT_EQ(window.steps_left(), 9);
}

TEST(TimeWindow, state_continues_to_the_bit) {
  TimeWindow window(of(0.03, 1), 0.25), other = window;
  window.halve();
  for (int k = 0; k < 7; ++k) window.accept();
  other.set_state(window.state());
  EXPECT_EQ(walk(window).steps, walk(other).steps);
}

}  // namespace
}  // namespace fpi::coupling
