#include "coupling/time_window.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::coupling {
namespace {

constexpr double tolerance = 1e-9;  ///< of a step or an interval, for what round-off leaves

}  // namespace

TimeWindow::TimeWindow(const scene::Time& time, double output_interval)
    : nominal_(time.step),
      end_(time.end),
      interval_(output_interval),
      max_halvings_(static_cast<int>(time.max_halvings)),
      largest_(time.step) {
  plan(0);
}

/// The first multiple of the interval beyond `from`, or the end where that comes before or at the same place.
double TimeWindow::next_target(double from) const {
  if (interval_ <= 0) return end_;
  const double target = (std::floor(from / interval_ + tolerance) + 1) * interval_;
  return target < end_ - tolerance * interval_ ? target : end_;
}

void TimeWindow::plan(double from) {
  anchor_ = from;
  target_ = next_target(from);
  taken_ = 0;
  const double way = target_ - from, steps = std::ceil(way / largest_ - tolerance);
  count_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(steps));
  const double equal = way / static_cast<double>(count_);
  // Where the step divides the way, it keeps its bits, so that factors of matrices that contain it keep as
  // well.
  step_ = std::abs(equal - largest_) <= tolerance * largest_ ? largest_ : equal;
}

std::int64_t TimeWindow::steps_left() const {
  const double after_target = std::max(0.0, end_ - target_);
  return count_ - taken_ + static_cast<std::int64_t>(std::ceil(after_target / largest_ - tolerance));
}

void TimeWindow::accept() {
  ++taken_;
  const double now = start();
  const bool regrows = halvings_ > 0 && ++successes_ >= successes_to_regrow;
  if (regrows) {
    --halvings_;
    successes_ = 0;
    largest_ = halvings_ == 0 ? nominal_ : std::min(nominal_, 2 * largest_);
  }
  if ((regrows || taken_ == count_) && now < end_) plan(now);
}

bool TimeWindow::halve() {
  if (halvings_ >= max_halvings_) return false;
  ++halvings_;
  successes_ = 0;
  // Halves of the nominal step only, or repeated regrowth would let the step drift.
  for (largest_ = nominal_; largest_ > 0.75 * step_;) largest_ /= 2;
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
}

}  // namespace fpi::coupling
