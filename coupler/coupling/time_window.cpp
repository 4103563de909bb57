#include "coupling/time_window.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::coupling {
namespace {

constexpr double round_off = 1e-9;  ///< of a step or an interval
constexpr double safety = 0.9, most_growth = 2, least_change = 1.2, most_shrinkage = 5;

/// Only an error in time shows that a step may be larger than the one given.
double largest_allowed(const scene::Time& time) {
  if (time.max_step > 0) return time.max_step;
  return time.relative_tolerance > 0 ? std::max(time.end, time.step) : time.step;
}

}  // namespace

TimeWindow::TimeWindow(const scene::Time& time, double output_interval)
    : nominal_(time.step),
      end_(time.end),
      interval_(output_interval),
      adapts_(time.adapts()),
      bounds_error_(time.relative_tolerance > 0),
      smallest_(time.min_step > 0 ? time.min_step : 1e-3 * time.step),
      largest_allowed_(largest_allowed(time)),
      max_halvings_(static_cast<int>(time.max_halvings)),
      largest_(time.step) {
  plan(0);
}

/// The first multiple of the interval beyond `from`, or the end where that comes before or at the same place.
double TimeWindow::next_target(double from) const {
  if (interval_ <= 0) return end_;
  const double target = (std::floor(from / interval_ + round_off) + 1) * interval_;
  return target < end_ - round_off * interval_ ? target : end_;
}

void TimeWindow::plan(double from) {
  anchor_ = from;
  target_ = next_target(from);
  taken_ = 0;
  const double way = target_ - from, steps = std::ceil(way / largest_ - round_off);
  count_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(steps));
  const double equal = way / static_cast<double>(count_);
  // Where the step divides the way, it keeps its bits, so that factors of matrices that contain it keep as
  // well.
  step_ = std::abs(equal - largest_) <= round_off * largest_ ? largest_ : equal;
}

std::int64_t TimeWindow::steps_left() const {
  const double after_target = std::max(0.0, end_ - target_);
  return count_ - taken_ + static_cast<std::int64_t>(std::ceil(after_target / largest_ - round_off));
}

/// An excess of 0 (a fluid at rest) gives an infinite factor: the step grows as much as it may.
double TimeWindow::wanted_step(std::span<const Demand> demands) const {
  double factor = most_growth;
  for (const Demand& demand : demands)
    factor = std::min(factor, safety * std::pow(demand.excess, -1 / demand.order));
  return std::clamp(step_ * std::max(factor, 1 / most_shrinkage), smallest_, largest_allowed_);
}

void TimeWindow::start_suddenly() {
  if (!bounds_error_) return;
  constexpr double share = 1.0 / 64;
  largest_ = std::max(smallest_, share * largest_);
  plan(start());
}

Verdict TimeWindow::judge(std::span<const Demand> demands) {
  if (std::ranges::all_of(demands, [](const Demand& d) { return d.excess <= d.most; })) return Verdict::take;
  if (step_ <= smallest_ * (1 + round_off)) return Verdict::take_at_smallest;
  largest_ = std::max(smallest_, std::min(wanted_step(demands), step_ / least_change));
  plan(start());
  return Verdict::repeat;
}

/// True where a halving has been made good by enough accepted steps.
bool TimeWindow::count_success() {
  if (halvings_ == 0 || ++successes_ < successes_to_regrow) return false;
  --halvings_;
  successes_ = 0;
  return true;
}

void TimeWindow::accept(std::span<const Demand> demands) {
  ++taken_;
  const double before = largest_, now = start();
  const bool regrows = count_success();
  if (!demands.empty()) {
    const double wanted = wanted_step(demands);
    const bool grows = wanted > least_change * largest_ && halvings_ == 0;
    if (grows || wanted < largest_ / least_change) largest_ = wanted;
  } else if (regrows) {
    const double regrown = halvings_ == 0 ? nominal_ : std::min(nominal_, 2 * largest_);
    largest_ = std::max(largest_, regrown);
  }
  if ((largest_ != before || taken_ == count_) && now < end_) plan(now);
}

bool TimeWindow::halve() {
  if (halvings_ >= max_halvings_) return false;
  ++halvings_;
  successes_ = 0;
  if (adapts_) {
    largest_ = 0.5 * step_;
  } else {  // halves of the nominal step only, or repeated regrowth would let the step drift
    for (largest_ = nominal_; largest_ > 0.75 * step_;) largest_ /= 2;
  }
  plan(start());
  return true;
}

std::vector<double> TimeWindow::state() const {
  return {largest_, static_cast<double>(halvings_), static_cast<double>(successes_), anchor_, target_,
          step_,    static_cast<double>(taken_),    static_cast<double>(count_)};
}

void TimeWindow::set_state(std::span<const double> state) {
  largest_ = state[0];
  halvings_ = static_cast<int>(state[1]);
  successes_ = static_cast<int>(state[2]);
  anchor_ = state[3];
  target_ = state[4];
  step_ = state[5];
  taken_ = static_cast<std::int64_t>(state[6]);
  count_ = static_cast<std::int64_t>(state[7]);
  if (taken_ == count_ && start() < end_) plan(start());  // the end was put off
}

}  // namespace fpi::coupling
