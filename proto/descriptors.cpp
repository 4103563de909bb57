#include "proto/descriptors.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/log.hpp"

namespace fpi::proto {
namespace {

constexpr rlim_t most = 65536;  ///< each costs memory; and some libraries go through all that may be open
constexpr rlim_t few = 4096;

}  // namespace

void raise_descriptor_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  const rlim_t wanted = std::max(limit.rlim_cur, std::min(limit.rlim_max, most));
  if (wanted < few)
    log::warning(
        "this process may have {} files and connections open at a time: many idle connections could take "
        "what "
        "results need; raise the limit (ulimit -Hn)",
        wanted);
  if (wanted == limit.rlim_cur) return;
  limit.rlim_cur = wanted;
  if (setrlimit(RLIMIT_NOFILE, &limit) != 0)
    log::warning("the limit of open files could not be raised to {}: {}", wanted, std::strerror(errno));
}

}  // namespace fpi::proto
