/// Text from outside: what is UTF-8, what can be shown, and what is shown instead.
#include "core/text.hpp"

#include <gtest/gtest.h>

namespace fpi {
namespace {

constexpr const char* well_formed[] = {
    "", "density", "Δt = 1 µs", "\xf0\x9f\x8c\x8a", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"};

constexpr const char* malformed[] = {
    "\x80",              // a continuation without a lead
    "d\xe9placement",    // Latin-1
    "\xc3",              // cut off
    "\xe2\x82",          // cut off
    "\xc0\xaf",          // overlong "/"
    "\xe0\x80\xaf",      // overlong "/"
    "\xed\xa0\x80",      // a surrogate
    "\xf4\x90\x80\x80",  // above U+10FFFF
    "\xff",
};

TEST(Text, utf8_is_told_from_what_is_none) {
  for (const char* text : well_formed) EXPECT_TRUE(is_utf8(text)) << text;
  for (const char* text : malformed) EXPECT_FALSE(is_utf8(text)) << printable(text);
}

TEST(Text, with_control_characters_cannot_be_shown) {
  EXPECT_TRUE(is_printable("two\r\nlines\tof text"));
  for (const std::string_view text : {"\x1b[31m", "\x7f",
                                      "\xc2\x9b"
                                      "31m",
                                      "\x07"})
    EXPECT_TRUE(is_utf8(text) && !is_printable(text));
  EXPECT_FALSE(is_printable(std::string_view("\0", 1)));
  for (const char* text : malformed) EXPECT_FALSE(is_printable(text));
}

TEST(Text, is_shown_with_a_mark_in_place_of_what_cannot_be) {
  EXPECT_EQ(printable("Δt = 1 µs\n"), "Δt = 1 µs\n");
  EXPECT_EQ(printable("d\xe9placement"), "d\ufffdplacement");
  EXPECT_EQ(printable("\x1b[31mred"), "\ufffd[31mred");
  for (const char* text : malformed) EXPECT_TRUE(is_printable(printable(text)));
}

}  // namespace
}  // namespace fpi
