#include "results/signal.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace fpi {
namespace {

/// A range below this fraction of the signal itself is round-off.
constexpr double smallest_relative_range = 1e-6;
/// A crossing counts once the signal was this fraction of its range below the mean.
constexpr double hysteresis = 0.1;
constexpr std::size_t compared_peaks = 5;

struct Samples {
  std::span<const double> t, v;
  std::size_t size() const { return t.size(); }
};

/// The vertex of the parabola through the samples i − 1, i, i + 1; sample i itself at an end, on a straight
/// line, or where the vertex lies outside.
Extremum vertex_near(const Samples& s, std::size_t i) {
  const Extremum sample{.value = s.v[i], .time = s.t[i]};
  if (i == 0 || i + 1 == s.size()) return sample;
  const double before = s.t[i - 1] - s.t[i], after = s.t[i + 1] - s.t[i];
  const double slope_before = (s.v[i - 1] - s.v[i]) / before, slope_after = (s.v[i + 1] - s.v[i]) / after;
  const double curvature = (slope_after - slope_before) / (after - before);
  if (curvature == 0) return sample;
  const double slope = slope_before - curvature * before;  // at sample i
  const double offset = -0.5 * slope / curvature;
  if (!(offset > before && offset < after)) return sample;
  return {.value = s.v[i] + 0.5 * slope * offset, .time = s.t[i] + offset};
}

Extremum largest_between(const Samples& s, std::size_t begin, std::size_t end) {
  const auto first = s.v.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto found = std::max_element(first, s.v.begin() + static_cast<std::ptrdiff_t>(end));
  return vertex_near(s, static_cast<std::size_t>(found - s.v.begin()));
}

Extremum smallest(const Samples& s) {
  const auto found = std::min_element(s.v.begin(), s.v.end());
  return vertex_near(s, static_cast<std::size_t>(found - s.v.begin()));
}

/// Time of an upward crossing of a level, between samples `after` − 1 and `after`.
struct Crossing {
  double time;
  std::size_t after;
};

std::vector<Crossing> upward_crossings(const Samples& s, double level, double armed_below) {
  std::vector<Crossing> crossings;
  bool armed = false;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s.v[i] < armed_below) armed = true;
    if (!armed || s.v[i] < level) continue;
    armed = false;
    const double share = (level - s.v[i - 1]) / (s.v[i] - s.v[i - 1]);
    crossings.push_back({s.t[i - 1] + share * (s.t[i] - s.t[i - 1]), i});
  }
  return crossings;
}

/// By the trapezoidal rule.
double mean_of(const Samples& s) {
  double integral = 0;
  for (std::size_t i = 1; i < s.size(); ++i) integral += 0.5 * (s.v[i] + s.v[i - 1]) * (s.t[i] - s.t[i - 1]);
  return s.size() > 1 ? integral / (s.t.back() - s.t.front()) : s.v.front();
}

/// Between two crossings of `level`: the trapezoidal rule with the level at both ends.
double mean_between(const Samples& s, const Crossing& from, const Crossing& to, double level) {
  double integral = 0, t = from.time, v = level;
  for (std::size_t i = from.after; i < to.after; ++i) {
    integral += 0.5 * (v + s.v[i]) * (s.t[i] - t);
    t = s.t[i];
    v = s.v[i];
  }
  integral += 0.5 * (v + level) * (to.time - t);
  return integral / (to.time - from.time);
}

double spread_of_last_peaks(const Samples& s, const std::vector<Crossing>& crossings) {
  const std::size_t periods = crossings.size() - 1;
  std::vector<double> peaks;
  for (std::size_t k = periods - std::min(periods, compared_peaks); k < periods; ++k)
    peaks.push_back(largest_between(s, crossings[k].after, crossings[k + 1].after).value);
  const auto [low, high] = std::ranges::minmax(peaks);
  return high - low;
}

}  // namespace

SignalFigures analyse_signal(std::span<const double> time, std::span<const double> value) {
  require(!time.empty() && time.size() == value.size(), "as many times as values are required; got {} and {}",
          time.size(), value.size());
  const Samples s{time, value};
  SignalFigures out{smallest(s), largest_between(s, 0, s.size()), mean_of(s), std::nullopt};
  const double range = out.largest.value - out.smallest.value;
  const double size = std::max(std::abs(out.largest.value), std::abs(out.smallest.value));
  if (range <= smallest_relative_range * size) return out;
  // The mean over whole periods and the crossings that bound them depend on each other.
  double mean = out.mean;
  for (int pass = 0; pass < 4; ++pass) {
    const auto crossings = upward_crossings(s, mean, mean - hysteresis * range);
    if (crossings.size() < 2) return out;
    const int periods = static_cast<int>(crossings.size()) - 1;
    out.oscillation = {.frequency = periods / (crossings.back().time - crossings.front().time),
                       .periods = periods,
                       .peak_spread = spread_of_last_peaks(s, crossings) / range};
    mean = mean_between(s, crossings.front(), crossings.back(), mean);
    out.mean = mean;
  }
  return out;
}

}  // namespace fpi
