/// Where the time goes: named accumulators, filled by scoped timers. It belongs to one thread.
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace fpi {

/// Seconds and counts by name, e.g. {"factor": 1.25} s and {"factorisations": 40}.
struct Timers {
  std::map<std::string, double> seconds;
  std::map<std::string, double> counts;
};

/// Adds the time from its construction to its destruction to `timers.seconds[name]` [s].
class ScopedTimer {
 public:
  ScopedTimer(Timers& timers, const char* name) : total_(timers.seconds[name]) {}
  ~ScopedTimer() {
    total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;

 private:
  double& total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace fpi
