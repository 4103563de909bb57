/// Text from files and other programs: whether it is UTF-8, and pieces of it that an error can show.
#pragma once

#include <string>
#include <string_view>

namespace fpi {

/// Place of the first byte that does not belong to a character in UTF-8; the size of the text where all do.
std::size_t first_bad_byte(std::string_view text);

/// Throws Error with file and line where `text` is not UTF-8: it may be Latin-1 or UTF-16.
void require_utf8(std::string_view text, const std::string& file);

/// The text behind a byte-order mark of UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// At most `longest` bytes of `text` as an error shows them: whole characters, and \xHH for control
/// characters and what is not UTF-8.
std::string printable(std::string_view text, std::size_t longest = 60);

}  // namespace fpi
