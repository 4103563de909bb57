/// Numbers to bytes and back, for the states that participants save. Bytes that are read may be hostile:
/// every read is checked for length, every double for finiteness.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.hpp"

namespace fpi {

static_assert(std::endian::native == std::endian::little, "states are written as the machine has them");

class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(const T& value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(T));
  }
  void put(std::span<const double> values) {
    for (const double value : values) put(value);
  }
  /// With its length before it.
  void put_sized(std::span<const std::uint8_t> block) {
    put(static_cast<std::uint64_t>(block.size()));
    bytes.insert(bytes.end(), block.begin(), block.end());
  }
  std::vector<std::uint8_t> bytes;
};

/// `what` stands for the state in errors, e.g. "the fluid's state".
class ByteReader {
 public:
  ByteReader(std::span<const std::uint8_t> bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

  template <class T>
  requires std::is_arithmetic_v<T> T get() {
    require(bytes_.size() >= sizeof(T), "{} ends too early: take another checkpoint", what_);
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  /// A finite double.
  double number() {
    const double value = get<double>();
    require(std::isfinite(value), "{} must have finite numbers; got {}: take another checkpoint", what_,
            value);
    return value;
  }
  void numbers(std::span<double> values) {
    for (double& value : values) value = number();
  }
  /// What `put_sized` wrote.
  std::span<const std::uint8_t> sized() {
    const auto size = get<std::uint64_t>();
    require(bytes_.size() >= size, "{} ends too early: take another checkpoint", what_);
    const auto block = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return block;
  }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::string what_;
};

}  // namespace fpi
