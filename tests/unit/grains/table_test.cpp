#include "grains/table.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace fpi::grains {
namespace {

std::string error_of(const std::string& text, std::size_t axes = 2) {
  try {
    read_table(text, "sand.csv", axes);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Table, reads_columns_in_any_order_and_lines_of_any_system) {
  const Table table =
      read_table("radius, y,x ,vx,spin\r\n1e-3,2,1,-4,5\r\n\r\n2e-3,4,3,0.5,0\n", "sand.csv", 2);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].sphere.centre, (Vec3{1, 2, 0}));
  EXPECT_EQ(table.rows[0].sphere.radius, 1e-3);
  EXPECT_EQ(table.rows[0].velocity, (Vec3{-4, 0, 0}));
  EXPECT_EQ(table.rows[0].spin, (Vec3{0, 0, 5}));
  EXPECT_TRUE(table.has_velocity);
  EXPECT_TRUE(table.has_spin);
  EXPECT_EQ(read_table("x,y,z,radius,spin_y\n1,2,3,4,5", "sand.csv", 3).rows[0].spin, (Vec3{0, 5, 0}));
}

TEST(Table, takes_what_spreadsheets_and_other_systems_write) {
  const Table plain = read_table("x,y,radius\n0.02,-2,0.01\n3,4,0.5\n", "sand.csv", 2);
  for (const char* text :
       {"\xef\xbb\xbfx,y,radius\n0.02,-2,0.01\n3,4,0.5\n", "x,y,radius\n+2.0e-2,-2E0,+.01\n+3,4,.5\n",
        "x,y,radius\r0.02,-2,0.01\r3,4,0.5\r", "\"x\",\"y\",\"radius\"\n0.02,\"-2\",0.01\n3,4,0.5\n",
        "x,y,radius,\n0.02,-2,0.01,\n3,4,0.5,\n\n\n"}) {
    const Table table = read_table(text, "sand.csv", 2);
    ASSERT_EQ(table.rows.size(), 2u) << text;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(table.rows[i].sphere.centre, plain.rows[i].sphere.centre) << text;
      EXPECT_EQ(table.rows[i].sphere.radius, plain.rows[i].sphere.radius) << text;
    }
  }
}

TEST(Table, other_separators_decimal_commas_and_encodings_get_a_hint) {
  EXPECT_EQ(error_of("x;y;radius\n0,02;0,02;0,01\n"),
            "sand.csv:1: columns separated by commas are required; got semicolons: write commas between the "
            "columns, "
            "and decimal points in the numbers");
  EXPECT_EQ(error_of("x\ty\tradius\n1\t2\t3\n").substr(0, 64),
            "sand.csv:1: columns separated by commas are required; got tabs: ");
  EXPECT_EQ(error_of("x,y,radius\n0,02,0,02,0,01\n"),
            "sand.csv:2: a number for each of 3 columns is required; got 6: correct the line; decimals take "
            "a point, a "
            "comma ends a column");
  EXPECT_EQ(error_of(std::string("\xff\xfex\0,\0y\0", 8)),
            "sand.csv:1: text in UTF-8 is required; got UTF-16: save the file in UTF-8");
  EXPECT_NE(error_of("X,y,radius\n").find("got \"X\" (did you mean \"x\"?)"), std::string::npos);
}

TEST(Table, numbers_whose_volumes_are_not_finite_are_refused) {
  for (const char* row : {"0,0,1e307", "0,0,1e-310", "1e200,0,1", "0,-1e51,1"})
    EXPECT_NE(error_of(std::string("x,y,radius\n") + row + "\n").find("sand.csv:2, column"),
              std::string::npos)
        << row;
}

TEST(Table, an_error_names_file_line_and_column) {
  EXPECT_EQ(error_of("x,y,radius\n1,2,3\n1,two,3\n"),
            "sand.csv:3, column 2 (y): a finite number is required; got \"two\": correct it");
  EXPECT_EQ(error_of("x,y,radius\n1,2,-3\n"),
            "sand.csv:2, column 3 (radius): a finite number > 0 m is required; got \"-3\": correct it");
  EXPECT_EQ(error_of("x,y,radius\n1,2\n"),
            "sand.csv:2: a number for each of 3 columns is required; got 2: correct the line");
  EXPECT_EQ(error_of("x,y,r\n"),
            "sand.csv:1, column 3: a column must be one of x, y, radius, vx, vy, spin; got \"r\": correct "
            "its name or "
            "remove it");
  EXPECT_EQ(error_of("x,y,x\n"),
            "sand.csv:1, column 3: a column must be given once; got \"x\" again: remove one");
  EXPECT_EQ(
      error_of("x,radius\n1,2\n"),
      "sand.csv:1: the first line must name the columns and among them \"y\"; got \"x,radius\": add it");
  EXPECT_EQ(error_of("x,y,radius\n"),
            "sand.csv: a line for each grain is required after the first; got none: add them");
  EXPECT_NE(error_of(""), "");
  EXPECT_NE(error_of("x,y,radius\n1,inf,2\n"), "");
  EXPECT_NE(error_of("x,y,radius\n1,1e999,2\n"), "");
}

}  // namespace
}  // namespace fpi::grains
