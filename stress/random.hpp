/// Random numbers that a seed and a name determine, the same with every compiler.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

#include "core/hash.hpp"

namespace fpi::fluid::testing {

class Random {
 public:
  Random(std::uint64_t seed, std::string_view name) : engine_(fnv1a(name) + 0x9e3779b97f4a7c15u * seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// Alike in each decade.
  double over_decades(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(between(0, static_cast<double>(n))); }
  double sign() { return below(2) == 0 ? -1 : 1; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace fpi::fluid::testing
