/// All arithmetic of time.
#include "coupling/time_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
