#include "stl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "core/error.hpp"

namespace fpi::dem {
namespace {

const std::string text =
    "solid square\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0.5\nvertex 1 0 0.5\nvertex 1 1 0.5\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0.5\nvertex 1 1 0.5\nvertex 0 1 0.5\nendloop\nendfacet\n"
    "endsolid square\n";

/// The same square as bytes; `n` triangles are announced.
std::string binary(std::uint32_t n = 2) {
  std::string bytes(80, '\0');
  const auto put = [&bytes](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(n);
  for (const auto& corners : {std::array<float, 9>{0, 0, .5F, 1, 0, .5F, 1, 1, .5F},
                              std::array<float, 9>{0, 0, .5F, 1, 1, .5F, 0, 1, .5F}}) {
    for (const float normal : {0.F, 0.F, 1.F}) put(normal);
    for (const float corner : corners) put(corner);
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string refusal(const std::string& bytes) {
  try {
    read_stl(bytes, "a.stl");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

std::string with(std::string bytes, const std::string& from, const std::string& to) {
  return bytes.replace(bytes.find(from), from.size(), to);
}

TEST(Stl, text_and_binary_files_hold_the_same_triangles) {
  const std::vector<Corners> from_text = read_stl(text, "a.stl").triangles;
  ASSERT_EQ(from_text.size(), 2u);
  EXPECT_EQ(from_text[1][1], Vec3(1, 1, 0.5));
  EXPECT_EQ(read_stl(binary(), "a.stl").triangles, from_text);
}

TEST(Stl, text_keeps_every_digit_far_from_the_origin) {
  const std::string far = with(text, "vertex 1 1 0.5", "vertex 500000.01299999998 +1e0 0.5");
  EXPECT_EQ(read_stl(far, "a.stl").triangles[0][2], Vec3(500000.01299999998, 1, 0.5));
}

TEST(Stl, text_may_be_in_capitals_and_of_any_system) {
  std::string capitals = text, windows;
  std::ranges::transform(capitals, capitals.begin(),
                         [](char c) { return static_cast<char>(std::toupper(c)); });
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& variant : {capitals, windows, "\xef\xbb\xbf" + text})
    EXPECT_EQ(read_stl(variant, "a.stl").triangles, read_stl(text, "a.stl").triangles) << variant;
}

TEST(Stl, every_solid_of_a_text_is_read) { EXPECT_EQ(read_stl(text + text, "a.stl").triangles.size(), 4u); }

TEST(Stl, a_normal_need_not_be_a_number) {
  EXPECT_EQ(read_stl(with(text, "normal 0 0 1", "normal nan -nan(ind) inf"), "a.stl").triangles.size(), 2u);
}

TEST(Stl, a_binary_file_may_begin_with_solid_and_have_some_bytes_behind_its_triangles) {
  std::string bytes = binary();
  bytes.replace(0, 5, "solid");
  for (const std::string& variant : {bytes, bytes + "sixteen bytes!!!", binary() + "sixteen bytes!!!"})
    EXPECT_EQ(read_stl(variant, "a.stl").triangles, read_stl(text, "a.stl").triangles);
}

TEST(Stl, a_binary_file_with_more_triangles_than_it_counts_is_refused) {
  EXPECT_NE(refusal(binary(1)).find(
                "a.stl: a binary STL file that counts its triangles is required; got a count of 1 "
                "in a file with room for 2"),
            std::string::npos)
      << refusal(binary(1));
}

TEST(Stl, a_note_says_where_single_precision_is_coarse) {
  EXPECT_EQ(read_stl(binary(), "a.stl").note, "");
  std::string bytes = binary();
  const float far = 500000.F;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t corner = 0; corner < 3; ++corner)
      std::memcpy(bytes.data() + 84 + 50 * i + 12 * (corner + 1), &far, sizeof far);
  EXPECT_EQ(read_stl(bytes, "a.stl").note,
            "a.stl: a binary STL file holds single precision: its coordinates are rounded to 0.031, and the "
            "mesh is 1 "
            "across; write it as text, or closer to the origin");
}

TEST(Stl, an_error_names_the_file_as_the_user_wrote_it_and_the_line_of_a_text) {
  EXPECT_EQ(refusal(with(text, "vertex 1 1", "vertex one 1")),
            "a.stl:6: a number is required; got one: write the STL file anew");
  EXPECT_NE(refusal(with(text, "endloop", "end")).find("a.stl:7: endloop is required; got end"),
            std::string::npos);
}

TEST(Stl, refuses_what_is_no_whole_file_of_finite_triangles) {
  for (const std::string& bytes :
       {std::string("x"), std::string("hello, world"), std::string("solid a\nendsolid a\n"),
        text.substr(0, 150), binary().substr(0, 150), binary(3), binary(0xffffffff), std::string(84, '\0'),
        with(text, "vertex 1 1", "vertex nan 1"), with(text, "vertex 1 1", "vertex one 1")}) {
    EXPECT_NE(refusal(bytes).find("a.stl"), std::string::npos) << bytes << refusal(bytes);
  }
}

}  // namespace
}  // namespace fpi::dem
