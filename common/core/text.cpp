#include "core/text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/error.hpp"

namespace fpi {
namespace {

struct Character {
  std::size_t length = 0;  ///< bytes; 0: not UTF-8
  char32_t code = 0;
};

/// The first character of `text`, which is not empty.
Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {1, lead};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  constexpr char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  char32_t code = lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < smallest[length] || code > 0x10ffff || is_surrogate ? Character{} : Character{length, code};
}

bool is_control(char32_t code) {
  const bool is_layout = code == '\n' || code == '\r' || code == '\t';
  return (code < 0x20 && !is_layout) || (code >= 0x7f && code < 0xa0);
}

bool is_utf16(std::string_view text) { return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"); }

bool is_shown(const Character& character) { return character.length > 0 && !is_control(character.code); }

template <class Rule>
bool all_characters(std::string_view text, Rule&& rule) {
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!rule(character)) return false;
    text.remove_prefix(character.length);
  }
  return true;
}

}  // namespace

std::size_t first_bad_byte(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = first_character(text.substr(at)).length;
    if (length == 0) break;
    at += length;
  }
  return at;
}

bool is_utf8(std::string_view text) { return first_bad_byte(text) == text.size(); }

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

bool is_printable(std::string_view text) { return all_characters(text, is_shown); }

std::string printable(std::string_view text) {
  constexpr std::string_view replacement = "\xef\xbf\xbd";
  std::string shown;
  while (!text.empty()) {
    const Character character = first_character(text);
    const std::size_t length = std::max<std::size_t>(1, character.length);
    shown += is_shown(character) ? text.substr(0, length) : replacement;
    text.remove_prefix(length);
  }
  return shown;
}

std::string excerpt(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    const Character character = first_character(text);
    const bool is_plain = character.length > 1 || (text[0] >= 0x20 && text[0] != 0x7f);
    const std::string shown = character.length > 0 && is_plain
                                  ? std::string(text.substr(0, character.length))
                                  : fmt::format("\\x{:02X}", static_cast<std::uint8_t>(text[0]));
    if (out.size() + shown.size() > longest) return out + "…";
    out += shown;
    text.remove_prefix(std::max<std::size_t>(character.length, 1));
  }
  return out;
}

}  // namespace fpi
