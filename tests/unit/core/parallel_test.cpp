#include "core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace fpi {
namespace {

TEST(ParallelFor, does_every_piece_once) {
  for (const int n : {0, 1, 2, 1000}) {
    std::vector<std::atomic<int>> done(n);
    parallel_for(n, [&](int i) { ++done[i]; });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
}

}  // namespace
}  // namespace fpi
