#include "core/utf8.hpp"

#include <algorithm>
#include <cstdint>

#include "core/error.hpp"

namespace fpi {
namespace {

bool is_continuation(char c) { return (static_cast<std::uint8_t>(c) & 0xc0) == 0x80; }

/// Bytes that a character has by its first one; 0 of a byte that begins none.
std::size_t announced_length(std::uint8_t first) {
  if (first < 0x80) return 1;
  if (first < 0xc2) return 0;
  if (first < 0xe0) return 2;
  if (first < 0xf0) return 3;
  return first < 0xf5 ? 4 : 0;
}

/// Bytes of the character at the start of `text`; 0 where there is none. Overlong forms, surrogates and
/// numbers above U+10FFFF are none.
std::size_t character_length(std::string_view text) {
  const auto first = static_cast<std::uint8_t>(text[0]);
  const std::size_t length = announced_length(first);
  if (length == 0 || length > text.size()) return 0;
  if (!std::ranges::all_of(text.substr(1, length - 1), is_continuation)) return 0;
  const auto second = static_cast<std::uint8_t>(length > 1 ? text[1] : '\0');
  const bool is_bad = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                      (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return is_bad ? 0 : length;
}

bool is_utf16(std::string_view text) { return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"); }

}  // namespace

std::size_t first_bad_byte(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = character_length(text.substr(at));
    if (length == 0) break;
    at += length;
  }
  return at;
}

void require_utf8(std::string_view text, const std::string& file) {
  const std::size_t bad = first_bad_byte(text);
  if (bad == text.size()) return;
  fail("{}:{}: text in UTF-8 is required; got {}: save the file in UTF-8", file,
       1 + std::ranges::count(text.substr(0, bad), '\n'),
       is_utf16(text) ? "UTF-16"
                      : fmt::format("the byte 0x{:02X}, as Latin-1 and other encodings have it",
                                    static_cast<std::uint8_t>(text[bad])));
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const bool is_control = length == 1 && (static_cast<std::uint8_t>(text[0]) < 0x20 || text[0] == 0x7f);
    const std::string shown = length == 0 || is_control
                                  ? fmt::format("\\x{:02X}", static_cast<std::uint8_t>(text[0]))
                                  : std::string(text.substr(0, length));
    if (out.size() + shown.size() > longest) return out + "…";
    out += shown;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace fpi
