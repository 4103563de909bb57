/// FNV-1a: the hash behind the fingerprints of scenes and of the message schema. Not for secrets.
#pragma once

#include <cstdint>
#include <string_view>

namespace fpi {

/// 64-bit FNV-1a of `text` (Fowler, Noll, Vo).
constexpr std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

}  // namespace fpi
