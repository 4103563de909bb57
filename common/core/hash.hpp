/// FNV-1a: the hash behind the fingerprints of scenes and of the message schema, and the checksum of
/// checkpoints. Not for secrets. Every step of it is one-to-one, so that a change of a single byte, wherever
/// it is, always shows.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace fpi {

/// 64-bit FNV-1a of `text` (Fowler, Noll, Vo); goes on from `hash`, that of what stands before.
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}
inline std::uint64_t fnv1a(std::span<const std::uint8_t> bytes) {
  return fnv1a(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace fpi
