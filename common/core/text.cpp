#include "core/text.hpp"

#include <algorithm>
#include <cstddef>

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

bool is_utf8(std::string_view text) {
  return all_characters(text, [](const Character& c) { return c.length > 0; });
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

}  // namespace fpi
