/// Text that came from outside, as a terminal or a log can show it.
#pragma once

#include <string>
#include <string_view>

namespace fpi {

/// True for UTF-8 without control characters, line feed, carriage return and tab excepted.
bool is_legible(std::string_view text);

/// `text` with U+FFFD in place of every byte or character that makes it illegible.
std::string legible(std::string_view text);

}  // namespace fpi
