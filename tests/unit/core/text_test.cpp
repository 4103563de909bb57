/// Text from outside: what can be shown, and what is shown instead.
#include "core/text.hpp"

#include <gtest/gtest.h>

namespace fpi {
namespace {

constexpr const char* not_utf8[] = {
    "\x80",              // a continuation without a lead
    "d\xe9placement",    // Latin-1
    "\xc3",              // cut off
    "\xe2\x82",          // cut off
    "\xc0\xaf",          // overlong "/"
    "\xed\xa0\x80",      // a surrogate
    "\xf4\x90\x80\x80",  // above U+10FFFF
    "\xff",
};

TEST(Text, in_utf8_is_legible) {
  for (const char* text :
       {"", "density", "Δt = 1 µs", "two\r\nlines\tof text", "\xf0\x9f\x8c\x8a", "\xc2\xa0"}) {
    EXPECT_TRUE(is_legible(text)) << text;
    EXPECT_EQ(legible(text), text);
  }
}

TEST(Text, in_another_encoding_or_with_control_characters_is_not) {
  for (const char* text : not_utf8) EXPECT_FALSE(is_legible(text)) << legible(text);
  for (const char* text : {"\x1b[31m", "\x7f",
                           "\xc2\x9b"
                           "31m",
                           "\x07"})
    EXPECT_FALSE(is_legible(text));
  EXPECT_FALSE(is_legible(std::string_view("\0", 1)));
}

TEST(Text, is_shown_with_a_mark_in_place_of_what_cannot_be) {
  EXPECT_EQ(legible("d\xe9placement"), "d\ufffdplacement");
  EXPECT_EQ(legible("\x1b[31mred\xc2\x9b"), "\ufffd[31mred\ufffd");
  for (const char* text : not_utf8) EXPECT_TRUE(is_legible(legible(text)));
}

}  // namespace
}  // namespace fpi
