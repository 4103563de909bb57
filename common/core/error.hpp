/// The one exception of the project, and the one way to raise it. Every message has three parts: what was
/// required, what came, and what to do; where it came from (file, line, key) is part of "what came".
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace fpi {

/// A request that cannot be carried out. Ordinary outcomes (not converged, malformed message) are returned.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws Error with the formatted sentence.
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(fmt::format(format, std::forward<Args>(args)...));
}

/// Throws Error with the formatted sentence unless `condition` holds.
template <class... Args>
void require(bool condition, fmt::format_string<Args...> format, Args&&... args) {
  if (!condition) fail(format, std::forward<Args>(args)...);
}

/// The entry of `candidates` that `word` was probably meant to be, or "" where none is near.
/// `candidates` is any range of strings.
std::size_t edit_distance(std::string_view a, std::string_view b);

template <class Range>
std::string did_you_mean(std::string_view word, const Range& candidates) {
  std::string best;
  std::size_t best_distance = 1 + word.size() / 3;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance <= best_distance) {
      if (distance < best_distance || best.empty()) best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace fpi
