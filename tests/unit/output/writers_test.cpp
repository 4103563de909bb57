/// The files of a run folder, written and read back.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../temporary_folder.hpp"
#include "core/error.hpp"
#include "output/body_writer.hpp"
#include "output/curve_writer.hpp"
#include "output/field_writer.hpp"
#include "output/interface_writer.hpp"
#include "output/replace.hpp"
#include "output/table.hpp"

namespace fpi::output {
namespace {

struct Writers : testing::Test {
  TemporaryFolder folder;
};

/// One quadratic triangle and its fields, scaled by `factor`.
void write_triangle(FieldWriter& writer, double time, double factor) {
  if (!writer.has_mesh()) {
    writer.write_mesh(std::vector<double>{0, 0, 1, 0, 0, 1, .5, 0, .5, .5, 0, .5},
                      std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
  }
  const std::vector<double> velocity(12, factor), pressure(6, 2 * factor), active{1};
  const std::vector<FieldView> fields{
      {"velocity", false, 2, velocity}, {"pressure", false, 1, pressure}, {"active", true, 1, active}};
  writer.write(time, fields);
}

TEST_F(Writers, fields_come_back_with_their_shapes_and_times) {
  FieldWriter writer(folder.path());
  write_triangle(writer, 0.5, 3);
  const H5File file = H5File::read(folder / "fields.h5");
  EXPECT_EQ(file.shape("/mesh/points"), (Shape{6, 2}));
  EXPECT_EQ(file.shape("/mesh/cells"), (Shape{1, 6}));
  EXPECT_EQ(file.shape("/steps/000000/velocity"), (Shape{6, 2}));
  EXPECT_EQ(file.shape("/steps/000000/pressure"), (Shape{6}));
  EXPECT_EQ(file.doubles("/steps/000000/active"), std::vector<double>{1});
  EXPECT_EQ(file.attribute("/steps/000000", "time"), 0.5);
}

TEST_F(Writers, xdmf_names_every_step_and_only_arrays_that_are_there) {
  FieldWriter writer(folder.path());
  write_triangle(writer, 0.5, 3);
  write_triangle(writer, 1, 4);
  const std::string xdmf = read_text_file(folder / "fields.xdmf");
  const H5File file = H5File::read(folder / "fields.h5");
  std::size_t named = 0;
  for (std::size_t at = 0; (at = xdmf.find("fields.h5:", at)) != std::string::npos; ++named) {
    at += std::string("fields.h5:").size();
    EXPECT_TRUE(file.has(xdmf.substr(at, xdmf.find('<', at) - at)));
  }
  EXPECT_EQ(named, 2u * 5u);
  EXPECT_NE(xdmf.find("<Time Value=\"0.5\"/>"), std::string::npos);
  EXPECT_NE(xdmf.find("<Time Value=\"1\"/>"), std::string::npos);
}

TEST_F(Writers, a_resumed_series_forgets_what_came_after_its_checkpoint) {
  {
    FieldWriter writer(folder.path());
    for (const double t : {1., 2., 3.}) write_triangle(writer, t, t);
  }
  FieldWriter writer(folder.path(), 1);
  EXPECT_EQ(writer.size(), 1u);
  write_triangle(writer, 2.5, 9);
  const H5File file = H5File::read(folder / "fields.h5");
  EXPECT_EQ(file.list("/steps").size(), 2u);
  EXPECT_EQ(file.attribute("/steps/000001", "time"), 2.5);
  EXPECT_EQ(file.doubles("/steps/000001/pressure"), std::vector<double>(6, 18));
  EXPECT_EQ(read_text_file(folder / "fields.xdmf").find("Value=\"3\""), std::string::npos);
}

TEST_F(Writers, a_series_shorter_than_its_checkpoint_is_refused) {
  { FieldWriter(folder.path()); }
  EXPECT_THROW(FieldWriter(folder.path(), 1), Error);
}

TEST_F(Writers, bodies_are_rows_of_time) {
  const BodyRow one{.position = {1, 2, 0},
                    .velocity = {3, 4, 0},
                    .spin = {0, 0, 5},
                    .force = {6, 7, 0},
                    .torque = {0, 0, 8}};
  {
    BodyWriter writer(folder.path(), {"a", "b"}, {0.5, 0.25});
    for (const double t : {1., 2., 3.}) writer.append(t, std::vector{one, BodyRow{}});
    EXPECT_EQ(writer.size(), 3u);
    writer.flush();
  }
  BodyWriter writer(folder.path(), 2);
  writer.append(9, std::vector{BodyRow{}, one});
  writer.flush();
  const H5File file = H5File::read(folder / "bodies.h5");
  EXPECT_EQ(file.doubles("/time"), (std::vector<double>{1, 2, 9}));
  EXPECT_EQ(file.texts("/name"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(file.doubles("/radius"), (std::vector<double>{0.5, 0.25}));
  for (const char* name : {"/position", "/velocity", "/spin", "/force", "/torque"}) {
    EXPECT_EQ(file.shape(name), (Shape{3, 2, 3})) << name;
  }
  const std::vector<double> torque = file.doubles("/torque");
  EXPECT_EQ(torque[2], 8);   // time 1, body a
  EXPECT_EQ(torque[17], 8);  // time 9, body b
}

TEST_F(Writers, tractions_come_back_arc_by_arc) {
  InterfaceWriter writer(folder.path());
  writer.write(0.1, {.body = {0, 0, 1},
                     .start = {0, 3, 0},
                     .end = {3, 6, 6},
                     .middle = {0, 1, 0, -1, 1, 2},
                     .traction = {1, 2, 3, 4, 5, 6},
                     .centre = {0, 0, 1, 1}});
  const H5File file = H5File::read(folder / "interface.h5");
  EXPECT_EQ(file.indices("/steps/000000/body"), (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(file.shape("/steps/000000/middle"), (Shape{3, 2}));
  EXPECT_EQ(file.doubles("/steps/000000/middle")[5], 2);
  EXPECT_EQ(file.shape("/steps/000000/traction"), (Shape{3, 2}));
  EXPECT_EQ(file.shape("/steps/000000/centre"), (Shape{2, 2}));
  EXPECT_EQ(file.doubles("/steps/000000/end"), (std::vector<double>{3, 6, 6}));
}

TEST_F(Writers, a_table_is_cut_to_its_checkpoint_and_continued) {
  const std::string path = folder / "history.csv";
  {
    Table table(path, {"time", "x"});
    for (const double t : {1., 2., 3.}) table.append(std::vector{t, 0.1});
  }
  Table table(path, 2);
  table.append(std::vector{4, 1. / 3});
  EXPECT_EQ(read_text_file(path), "time,x\n1,0.1\n2,0.1\n4,0.3333333333333333\n");
}

TEST_F(Writers, a_table_shorter_than_its_checkpoint_is_refused) {
  const std::string path = folder / "history.csv";
  { Table(path, {"time"}).append(std::vector{1.}); }
  EXPECT_THROW(Table(path, 2), Error);
}

TEST_F(Writers, replacing_a_text_leaves_nothing_else_behind) {
  const std::string path = folder / "text";
  replace_text(path, "old");
  replace_text(path, "new");
  EXPECT_EQ(read_text_file(path), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_THROW(replace_text(folder / "nowhere/text", ""), Error);
}

TEST_F(Writers, curves_come_back_by_name_and_a_resumed_file_goes_on_after_them) {
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 0.5, 0, 0}, values{1, 2, 3, 4, 5, 6};
  const std::vector<std::uint32_t> lines{0, 1, 2};
  const std::vector<CurveView> curves{{"wall", points, lines, 2, values},
                                      {"middle", points, {}, 1, std::span(values).first(3)}};
  CurveWriter(folder / "boundaries.h5", "traction").write(0.5, curves);
  CurveWriter resumed(folder / "boundaries.h5", "traction", 1);
  resumed.write(1, curves);
  EXPECT_EQ(resumed.size(), 2u);
  const H5File file = H5File::read(folder / "boundaries.h5");
  EXPECT_EQ(file.attribute("/steps/000001", "time"), 1);
  EXPECT_EQ(file.shape("/steps/000000/wall/points"), (Shape{3, 3}));
  EXPECT_EQ(file.indices("/steps/000000/wall/lines"), lines);
  EXPECT_EQ(file.shape("/steps/000001/wall/traction"), (Shape{3, 2}));
  EXPECT_EQ(file.doubles("/steps/000001/middle/traction"), (std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(file.has("/steps/000001/middle/lines"));
}

TEST_F(Writers, a_table_reads_back_by_column_without_a_half_written_line) {
  Table table(folder / "history.csv", {"time", "lift"});
  table.append(std::vector{0.1, 1.0 / 3});
  table.append(std::vector{0.2, std::nan("")});
  std::ofstream(folder / "history.csv", std::ios::app) << "0.3,1";
  const Columns columns = read_columns(folder / "history.csv");
  EXPECT_EQ(columns.at("time"), (std::vector{0.1, 0.2}));
  EXPECT_EQ(columns.at("lift")[0], 1.0 / 3);
  EXPECT_TRUE(std::isnan(columns.at("lift")[1]));
  EXPECT_THROW(read_columns(folder / "none.csv"), Error);
}

}  // namespace
}  // namespace fpi::output
