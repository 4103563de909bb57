#include "core/pages.hpp"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace fpi {
namespace {

/// Sanitizers bring an allocator of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

constexpr std::size_t large_page = std::size_t{1} << 21;

/// What this process may take of a resource [bytes].
std::size_t limit_of(__rlimit_resource resource) {
  rlimit limit{};
  const bool known = getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return known ? static_cast<std::size_t>(limit.rlim_cur) : std::numeric_limits<std::size_t>::max();
}

/// Half of the machine's memory: growth beyond it comes in small pages. Less where addresses are limited.
std::size_t reserve() {
  const std::size_t limit = std::min(limit_of(RLIMIT_AS), limit_of(RLIMIT_DATA));
  return std::min(machine_memory() / 2, limit / 4);
}

/// Memory [bytes] that the system could give without swapping; the largest number where it does not say.
std::size_t available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  std::size_t kilobytes = 0;
  while (file >> key >> kilobytes) {
    if (key == "MemAvailable:") return kilobytes * 1024;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::numeric_limits<std::size_t>::max();
}

/// Memory [bytes] of this process that is there and that no block lies in.
std::size_t unused_memory() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0, resident = 0;
  file >> total >> resident;
  resident *= static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return resident - std::min(resident, mallinfo2().uordblks);
}

}  // namespace

std::size_t machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(size) : 0;
}

void keep_pages() {
  const std::size_t bytes = reserve();
  if (is_sanitized || bytes < large_page) return;
  mallopt(M_MMAP_MAX, 0);         // large blocks come from the heap too
  mallopt(M_TRIM_THRESHOLD, -1);  // and what is freed stays there
  mallopt(M_TOP_PAD, 256 << 20);  // beyond the reserve
  void* first = std::malloc(bytes);
  const auto begin = (reinterpret_cast<std::uintptr_t>(first) + large_page - 1) / large_page * large_page;
  const auto end = reinterpret_cast<std::uintptr_t>(sbrk(0));
  if (first && begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  std::free(first);
}

void return_pages_where_scarce() {
  if (is_sanitized) return;
  using Clock = std::chrono::steady_clock;
  static Clock::time_point next = Clock::now();
  if (Clock::now() < next) return;
  if (unused_memory() > available_memory()) malloc_trim(0);
  next = Clock::now() + std::chrono::seconds(1);
}

}  // namespace fpi
