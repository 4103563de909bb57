/// A clock that stands still while this process does: what passes between two ticks counts as a short turn at
/// most. Whoever waits by it does not blame others for a pause of its own (stopped, asleep, or at work on
/// something else).
#pragma once

#include <algorithm>

#include "proto/transport/socket.hpp"

namespace fpi::proto {

class AttentiveClock {
 public:
  void tick() {
    const Clock::time_point before = std::exchange(last_, Clock::now());
    now_ += std::min(longest_turn, std::chrono::duration<double>(last_ - before).count());
  }
  double now() const { return now_; }  ///< [s]
  double since(double then) const { return now_ - then; }

 private:
  static constexpr double longest_turn = 0.2;  ///< [s]
  Clock::time_point last_ = Clock::now();
  double now_ = 0;
};

}  // namespace fpi::proto
