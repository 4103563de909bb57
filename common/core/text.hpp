/// Text that came from outside: whether it is UTF-8, and whether a terminal or a log can show it as it is.
#pragma once

#include <string>
#include <string_view>

namespace fpi {

/// True for well-formed UTF-8 (RFC 3629): no overlong forms, no surrogates, nothing above U+10FFFF.
bool is_utf8(std::string_view text);

/// True for UTF-8 without control characters, line feed, carriage return and tab excepted.
bool is_printable(std::string_view text);

/// `text` with U+FFFD in place of every byte or control character that is not printable.
std::string printable(std::string_view text);

}  // namespace fpi
