/// Text that came from outside, from files and other programs: whether it is UTF-8, whether a terminal or a
/// log can show it as it is, and pieces of it that an error can show.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fpi {

/// True for well-formed UTF-8 (RFC 3629): no overlong forms, no surrogates, nothing above U+10FFFF.
bool is_utf8(std::string_view text);

/// Place of the first byte that does not belong to a character in UTF-8; the size of the text where all do.
std::size_t first_bad_byte(std::string_view text);

/// Throws Error with file and line where `text` is not UTF-8: it may be Latin-1 or UTF-16.
void require_utf8(std::string_view text, const std::string& file);

/// The text behind a byte-order mark of UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// True for UTF-8 without control characters, line feed, carriage return and tab excepted.
bool is_printable(std::string_view text);

/// `text` with U+FFFD in place of every byte or control character that is not printable.
std::string printable(std::string_view text);

/// At most `longest` bytes of `text` as an error shows them: whole characters, and \xHH for control
/// characters and what is not UTF-8.
std::string excerpt(std::string_view text, std::size_t longest = 60);

}  // namespace fpi
