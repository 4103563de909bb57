#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <system_error>
#include <thread>
#include <vector>

namespace fpi {

int n_threads() {
  static const int n = [] {
    const char* given = std::getenv("OMP_NUM_THREADS");
    const int asked = given ? std::atoi(given) : 0;
    return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }();
  return n;
}

void parallel_for(int n, const std::function<void(int)>& work) {
  std::atomic<int> next = 0;
  const auto share = [&] {
    for (int i = next++; i < n; i = next++) work(i);
  };
  std::vector<std::jthread> helpers;
  try {
    for (int t = 1; t < std::min(n, n_threads()); ++t) helpers.emplace_back(share);
  } catch (const std::system_error&) {
    // Where no further thread can be had, the ones there are do the work.
  }
  share();
}

}  // namespace fpi
