/// Pairs that are near enough to act, collected until they are many enough to take several at once.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "core/lanes.hpp"

namespace fpi::dem {

/// For each set of lanes the numbers of those that are in it, one after another.
inline constexpr auto packed_lanes = [] {
  std::array<std::array<std::uint32_t, n_lanes>, 1 << n_lanes> table{};
  for (unsigned set = 0; set < table.size(); ++set) {
    for (unsigned lane = 0, k = 0; lane < n_lanes; ++lane)
      if (set >> lane & 1) table[set][k++] = lane;
  }
  return table;
}();
/// For each set of lanes a byte of ones for those in it.
inline constexpr auto lane_bytes = [] {
  std::array<std::uint32_t, 1 << n_lanes> table{};
  for (unsigned set = 0; set < table.size(); ++set) {
    for (unsigned lane = 0; lane < n_lanes; ++lane)
      if (set >> lane & 1) table[set] |= 0xffu << (8 * lane);
  }
  return table;
}();

struct Acting {
  static constexpr std::size_t most = 256;
  std::uint32_t pair[most + n_lanes], lower[most + n_lanes];
  std::size_t n = 0;

  bool full() const { return n > most - n_lanes; }

  /// Those of the pairs `first_pair` … of particle i whose lanes are in the set.
  void add(unsigned set, std::uint32_t first_pair, std::uint32_t i) {
    for (unsigned k = 0; k < n_lanes; ++k) {
      pair[n + k] = first_pair + packed_lanes[set][k];
      lower[n + k] = i;
    }
    n += static_cast<std::size_t>(std::popcount(set));
  }

  /// Calls take(pair, lower, count) for the lanes' number of pairs at once, of which the last may be repeated
  /// to fill up, and empties the collection.
  template <class Take>
  void empty(Take take) {
    for (std::size_t k = n; k % n_lanes != 0; ++k) {
      pair[k] = pair[n - 1];
      lower[k] = lower[n - 1];
    }
    for (std::size_t k = 0; k < n; k += n_lanes)
      take(&pair[k], &lower[k], std::min<std::size_t>(n_lanes, n - k));
    n = 0;
  }
};

}  // namespace fpi::dem
