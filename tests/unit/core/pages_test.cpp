#include "core/pages.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace fpi {
namespace {

long faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

/// Takes 64 MB, writes to it all, and frees it.
void fill_a_block() {
  std::vector<char> block(64 << 20, 1);
  asm volatile("" : : "r"(block.data()) : "memory");
}

TEST(Pages, memory_freed_once_is_had_again_without_asking_the_system) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers bring an allocator of their own";
#endif
  keep_pages();
  fill_a_block();
  const long before = faults();
  fill_a_block();
  return_pages_where_scarce();
  EXPECT_LT(faults() - before, 200);  // 16 384 pages of 4 kB else
}

}  // namespace
}  // namespace fpi
