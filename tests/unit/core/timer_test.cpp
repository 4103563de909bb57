/// Timers and scoped timers.
#include "core/timer.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace fpi {
namespace {

TEST(ScopedTimer, adds_the_time_of_its_scope_under_its_name) {
  Timers timers;
  for (int i = 0; i < 2; ++i) {
    const ScopedTimer timer(timers, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(timers.seconds.at("sleep"), 0.010);
  EXPECT_LT(timers.seconds.at("sleep"), 5.0);
  EXPECT_EQ(timers.seconds.size(), 1u);
}

TEST(ScopedTimer, nests) {
  Timers timers;
  {
    const ScopedTimer outer(timers, "outer");
    const ScopedTimer inner(timers, "inner");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GE(timers.seconds.at("outer"), timers.seconds.at("inner"));
  EXPECT_GT(timers.seconds.at("inner"), 0.0);
}

}  // namespace
}  // namespace fpi
