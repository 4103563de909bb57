/// A valid message of every type, every member with a value of its own; and equality to the last bit.
#pragma once

#include <bit>
#include <vector>

#include "proto/codec/members.hpp"

namespace fpi::proto::samples {

std::vector<Envelope> all();
Motion motion();
Interface arcs();
Interface surface();

inline bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <class T>
bool same(const T& a, const T& b) {
  if constexpr (requires {
                  a.size();
                  a[0];
                }) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (!same(a[i], b[i])) return false;
    return true;
  } else if constexpr (requires { a.first; }) {
    return a.first == b.first && same(a.second, b.second);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return a == b;
  } else {
    return std::apply([&](const auto&... m) { return (same(a.*(m.pointer), b.*(m.pointer)) && ...); },
                      members_of<T>);
  }
}

inline bool same_envelope(const Envelope& a, const Envelope& b) {
  if (a.stamp != b.stamp || a.message.index() != b.message.index()) return false;
  return std::visit(
      [&](const auto& m) { return same(m, std::get<std::remove_cvref_t<decltype(m)>>(b.message)); },
      a.message);
}

}  // namespace fpi::proto::samples
