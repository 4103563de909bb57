#include "core/text.hpp"

#include "core/utf8.hpp"

namespace fpi {
namespace {

/// Bytes of the control character at the start of `text`, which is UTF-8 and not empty; 0 where there is
/// none. Those of C1 (U+0080 to U+009F) have two.
std::size_t control_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const bool is_layout = first == '\n' || first == '\r' || first == '\t';
  if ((first < 0x20 && !is_layout) || first == 0x7f) return 1;
  return first == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0 ? 2 : 0;
}

constexpr std::string_view mark = "\xef\xbf\xbd";

/// With marks in place of control characters, of which `text`, which is UTF-8, may have some.
std::string without_controls(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t control = control_length(text);
    out += control > 0 ? mark : text.substr(0, 1);
    text.remove_prefix(control > 0 ? control : 1);
  }
  return out;
}

}  // namespace

bool is_legible(std::string_view text) {
  return first_bad_byte(text) == text.size() && without_controls(text) == text;
}

std::string legible(std::string_view text) {
  std::string out;
  for (std::size_t good; (good = first_bad_byte(text)) < text.size(); text.remove_prefix(good + 1)) {
    out += without_controls(text.substr(0, good));
    out += mark;
  }
  return out + without_controls(text);
}

}  // namespace fpi
