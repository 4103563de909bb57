/// Two bodies that may touch, by their numbers in the scene.
#pragma once

#include <compare>
#include <cstdint>

namespace fpi::dem {

/// Two bodies a < b of the scene.
struct Pair {
  std::uint32_t a = 0, b = 0;
  auto operator<=>(const Pair&) const = default;
};

}  // namespace fpi::dem
