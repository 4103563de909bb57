/// Numbers as files write them.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

namespace fpi {

/// Reals beyond are refused wherever they are read: volumes, masses and energies of larger ones overflow.
inline constexpr double largest_real = 1e50;
/// The smallest real that stands for a size above zero, for the same reason.
inline constexpr double smallest_positive_real = 1e-50;

/// The number that `text` is as a whole, with a plus sign or without; nothing where it is none, or one that
/// is not finite.
template <class Number>
std::optional<Number> to_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace fpi
