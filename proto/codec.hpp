/// Plain messages to bytes and back. Bytes from outside are hostile: size limit, FlatBuffers verification,
/// lengths that belong together, finite numbers, then use.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <variant>

#include "proto/messages.hpp"

namespace fpi::proto {

inline constexpr std::size_t largest_message = std::size_t{1} << 30;  ///< [B]

/// FNV-1a hash of fpi.fbs as this program was built with.
std::uint64_t schema_fingerprint();

Bytes encode(const Envelope& envelope);

/// Why bytes were not taken.
struct Malformed {
  std::string reason;
};
std::variant<Envelope, Malformed> decode(std::span<const std::uint8_t> bytes);

/// The name of a message's type, e.g. "FluidAdvance", for logs and errors.
const char* name(const Message& message);

}  // namespace fpi::proto
