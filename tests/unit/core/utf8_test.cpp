/// Text in UTF-8, and numbers as text.
#include "core/utf8.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/number.hpp"

namespace fpi {
namespace {

std::string error_of(std::string_view text) {
  try {
    require_utf8(text, "scene.toml");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Utf8, characters_of_every_length_are_taken) {
  const std::string text = "a\x7f\u00e9\u20ac\U0001f600\U0010ffff";
  EXPECT_EQ(first_bad_byte(text), text.size());
  EXPECT_EQ(first_bad_byte(""), 0u);
}

TEST(Utf8, what_is_no_character_is_found) {
  for (const std::string bad : {"\x80", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf0\x80\x80\x80",
                                "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xe2\x82", "\xc3"})
    EXPECT_EQ(first_bad_byte("ab" + bad), 2u) << printable(bad);
}

TEST(Utf8, an_error_says_the_line_and_what_the_text_may_be) {
  EXPECT_EQ(error_of("# Gr\xc3\xb6\xc3\x9f"
                     "e\n"),
            "");
  EXPECT_EQ(error_of("a = 1\n# Gr\xf6\xdf"
                     "e\n"),
            "scene.toml:2: text in UTF-8 is required; got the byte 0xF6, as Latin-1 and other encodings have "
            "it: save "
            "the file in UTF-8");
  EXPECT_NE(error_of("\xff\xfe"
                     "a")
                .find("got UTF-16"),
            std::string::npos);
}

TEST(Utf8, what_an_error_shows_is_whole_characters) {
  EXPECT_EQ(printable("a\tb\xff"), "a\\x09b\\xFF");
  EXPECT_EQ(printable("\u00e9\u00e9\u00e9", 5), "\u00e9\u00e9\u2026");
}

TEST(Number, is_the_whole_text_and_may_have_a_plus_sign) {
  EXPECT_EQ(to_number<double>("+0.02"), 0.02);
  EXPECT_EQ(to_number<double>("-.5E+1"), -5.0);
  EXPECT_EQ(to_number<int>("+7"), 7);
  for (const char* text : {"", "+", "+-1", "++1", "1 ", "0,5", "1e999", "nan", "-inf", "0x1"})
    EXPECT_FALSE(to_number<double>(text)) << text;
}

}  // namespace
}  // namespace fpi
