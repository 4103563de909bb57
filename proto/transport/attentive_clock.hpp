/// A clock that stands still while this process does: what passes between two ticks counts as a short turn at
/// most. Whoever waits by it does not blame others for a pause of its own (stopped, asleep, or at work on
/// something else).
#pragma once

#include <algorithm>
#include <utility>

#include "proto/transport/socket.hpp"

namespace fpi::proto {

class AttentiveClock {
 public:
  void tick() {
    const Clock::time_point before = std::exchange(last_, Clock::now());
    const double passed = std::chrono::duration<double>(last_ - before).count();
    now_ += std::min(longest_turn, passed);
    missed_ += std::max(0.0, passed - longest_turn);
  }
  double now() const { return now_; }  ///< [s]
  double since(double then) const { return now_ - then; }
  double missed() const { return missed_; }  ///< [s] that did not count

 private:
  static constexpr double longest_turn = 0.5;  ///< [s]
  Clock::time_point last_ = Clock::now();
  double now_ = 0, missed_ = 0;
};

}  // namespace fpi::proto
