/// Extrema, means and frequencies of sampled signals.
#include "results/signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/error.hpp"

namespace fpi {
namespace {

SignalFigures figures(const std::function<double(double)>& signal, double step, double end) {
  std::vector<double> t, v;
  for (int i = 0; i * step <= end; ++i) {
    t.push_back(i * step);
    v.push_back(signal(t.back()));
  }
  return analyse_signal(t, v);
}

double wave(double cycles) { return std::sin(2 * std::numbers::pi * cycles); }

TEST(Signal, finds_the_vertex_of_a_parabola_between_uneven_samples) {
  const std::vector<double> t{0, 0.3, 0.7, 0.8, 1};
  std::vector<double> v;
  for (const double x : t) v.push_back(2 - 3 * (x - 0.55) * (x - 0.55));
  const SignalFigures f = analyse_signal(t, v);
  EXPECT_NEAR(f.largest.value, 2, 1e-14);
  EXPECT_NEAR(f.largest.time, 0.55, 1e-14);
  EXPECT_EQ(f.smallest.time, 0);
  EXPECT_FALSE(f.oscillation);
}

TEST(Signal, of_one_sample_is_that_sample) {
  const SignalFigures f = figures([](double) { return 3.0; }, 1, 0.5);
  EXPECT_EQ(f.largest.value, 3);
  EXPECT_EQ(f.smallest.value, 3);
  EXPECT_EQ(f.mean, 3);
}

TEST(Signal, gives_frequency_mean_and_peaks_of_a_wave) {
  const SignalFigures f = figures([](double t) { return 3.2 + 0.5 * wave(3.0141 * t + 0.123); }, 0.01, 4.03);
  ASSERT_TRUE(f.oscillation);
  EXPECT_NEAR(f.oscillation->frequency, 3.0141, 1e-4);
  EXPECT_EQ(f.oscillation->periods, 11);
  EXPECT_TRUE(f.oscillation->is_settled());
  EXPECT_NEAR(f.mean, 3.2, 1e-4);
  EXPECT_NEAR(f.largest.value, 3.7, 1e-5);
  EXPECT_NEAR(f.smallest.value, 2.7, 1e-5);
}

TEST(Signal, counts_a_period_with_two_crests_once) {
  const auto f =
      figures([](double t) { return wave(2 * t) + 0.4 * wave(4 * t) + 0.02 * wave(31 * t); }, 0.001, 5);
  ASSERT_TRUE(f.oscillation);
  EXPECT_NEAR(f.oscillation->frequency, 2, 2e-3);
}

TEST(Signal, that_grows_is_not_settled) {
  const SignalFigures f = figures([](double t) { return std::exp(0.2 * t) * wave(t); }, 0.01, 10);
  ASSERT_TRUE(f.oscillation);
  EXPECT_GT(f.oscillation->periods, 5);
  EXPECT_FALSE(f.oscillation->is_settled());
}

TEST(Signal, of_few_periods_is_not_settled) {
  const SignalFigures f = figures([](double t) { return wave(t); }, 0.01, 4);
  ASSERT_TRUE(f.oscillation);
  EXPECT_LT(f.oscillation->periods, 5);
  EXPECT_FALSE(f.oscillation->is_settled());
}

TEST(Signal, that_changes_by_round_off_does_not_oscillate) {
  EXPECT_FALSE(figures([](double t) { return 5.57 + 1e-12 * wave(t); }, 0.01, 10).oscillation);
}

TEST(Signal, needs_as_many_times_as_values) {
  EXPECT_THROW(analyse_signal({}, {}), Error);
  const std::vector<double> two{0, 1}, one{0};
  EXPECT_THROW(analyse_signal(two, one), Error);
}

}  // namespace
}  // namespace fpi
