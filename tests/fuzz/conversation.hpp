/// Several messages in one input, as one side of a run sends them one after another: each is its length (four
/// bytes, little-endian) and its bytes.
#pragma once

#include <cstring>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/log.hpp"
#include "fuzz.hpp"
#include "proto/codec.hpp"

namespace fpi::fuzz {

inline Bytes conversation(const std::vector<proto::Envelope>& envelopes) {
  Bytes all;
  for (const proto::Envelope& envelope : envelopes) {
    const proto::Bytes message = proto::encode(envelope);
    const auto length = static_cast<std::uint32_t>(message.size());
    for (unsigned shift = 0; shift < 32; shift += 8)
      all.push_back(static_cast<std::uint8_t>(length >> shift));
    all.insert(all.end(), message.begin(), message.end());
  }
  return all;
}

/// The messages of an input; a length that goes beyond its end takes what is left.
class Conversation {
 public:
  Conversation(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  /// The next message, decoded as a program decodes what came; nothing at the end, or where it would be
  /// refused.
  std::optional<proto::Envelope> next() {
    std::uint32_t length = 0;
    if (left_.size() < sizeof length) return std::nullopt;
    std::memcpy(&length, left_.data(), sizeof length);
    left_ = left_.subspan(sizeof length);
    const std::size_t taken = std::min<std::size_t>(length, left_.size());
    auto decoded = proto::decode(left_.first(taken));
    left_ = left_.subspan(taken);
    auto* envelope = std::get_if<proto::Envelope>(&decoded);
    return envelope ? std::optional(std::move(*envelope)) : std::nullopt;
  }

 private:
  std::span<const std::uint8_t> left_;
};

/// Keeps what programs say of hostile messages from the terminal, unless FPI_FUZZ_LOG is set: to see what one
/// input does.
inline void be_quiet() {
  static std::once_flag once;
  std::call_once(once, [] {
    log::open("fuzz", "", std::getenv("FPI_FUZZ_LOG") ? log::Level::debug : log::Level::error);
  });
}

/// Whatever a participant is asked, it answers or refuses with an error; its answers are fit to be read.
template <class Desk>
void ask_all(Conversation conversation, Desk& desk) {
  be_quiet();
  try {
    while (const std::optional<proto::Envelope> request = conversation.next())
      proto::decode(proto::encode({request->stamp, desk.answer(*request)}));
  } catch (const std::exception& e) {
    log::info("the program reports and ends: {}", e.what());
  }
}

}  // namespace fpi::fuzz
