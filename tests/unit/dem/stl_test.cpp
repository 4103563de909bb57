#include "stl.hpp"

#include <gtest/gtest.h>

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
  const std::vector<Corners> from_text = read_stl(text, "a.stl");
  ASSERT_EQ(from_text.size(), 2u);
  EXPECT_EQ(from_text[1][1], Vec3(1, 1, 0.5));
  EXPECT_EQ(read_stl(binary(), "a.stl"), from_text);
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
