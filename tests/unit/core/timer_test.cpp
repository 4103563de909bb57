/// Ledger and scoped timers.
#include "core/timer.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace fpi {
namespace {

TEST(ScopedTimer, adds_the_time_of_its_scope_under_its_name) {
  Ledger ledger;
  for (int i = 0; i < 2; ++i) {
    const ScopedTimer timer(ledger, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GE(ledger.seconds.at("sleep"), 0.010);
  EXPECT_LT(ledger.seconds.at("sleep"), 5.0);
  EXPECT_EQ(ledger.seconds.size(), 1u);
}

TEST(ScopedTimer, nests) {
  Ledger ledger;
  {
    const ScopedTimer outer(ledger, "outer");
    const ScopedTimer inner(ledger, "inner");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GE(ledger.seconds.at("outer"), ledger.seconds.at("inner"));
  EXPECT_GT(ledger.seconds.at("inner"), 0.0);
}

}  // namespace
}  // namespace fpi
