/// HDF5 files, written and read back.
#include "output/h5_file.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "../temporary_folder.hpp"
#include "core/error.hpp"

namespace fpi::output {
namespace {

struct H5FileTest : testing::Test {
  TemporaryFolder folder;
  std::string path = folder / "file.h5";
};

TEST_F(H5FileTest, arrays_come_back_to_the_bit_with_their_shape) {
  const std::vector<double> values{0.1, -2, 3e300, 5e-324, 0, 7};
  const std::vector<std::uint32_t> indices{0, 4294967295u};
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  {
    H5File file = H5File::replacing(path);
    file.write("/a/b/values", values, {3, 2});
    file.write("/indices", indices, {2});
    file.write("/bytes", bytes);
    file.write("/none", std::vector<double>{}, {0});
    file.publish(Durable::now);
  }
  const H5File file = H5File::read(path);
  EXPECT_EQ(file.doubles("/a/b/values"), values);
  EXPECT_EQ(file.shape("/a/b/values"), (Shape{3, 2}));
  EXPECT_EQ(file.indices("/indices"), indices);
  EXPECT_EQ(file.bytes("/bytes"), bytes);
  EXPECT_TRUE(file.doubles("/none").empty());
}

TEST_F(H5FileTest, texts_come_back) {
  const std::vector<std::string> texts{"disc", "Körper ρ", ""};
  H5File file = H5File::replacing(path);
  file.write("/texts", texts);
  file.publish(Durable::after_sync);
  EXPECT_EQ(H5File::read(path).texts("/texts"), texts);
}

TEST_F(H5FileTest, rows_are_added_and_cut_off) {
  H5File file = H5File::replacing(path);
  for (double k = 0; k < 4; k += 2) {
    file.append("/time", std::vector{k, k + 1}, {});
    file.append("/position", std::vector{k, -k, k + 1, -k - 1}, {1, 2});
  }
  file.append("/time", std::vector{4.}, {});
  EXPECT_EQ(file.shape("/position"), (Shape{4, 1, 2}));
  file.keep_rows("/position", 2);
  EXPECT_EQ(file.doubles("/position"), (std::vector<double>{0, 0, 1, -1}));
  EXPECT_EQ(file.doubles("/time"), (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_THROW(file.keep_rows("/time", 6), Error);
}

TEST_F(H5FileTest, a_group_may_be_another_file_with_marks_of_its_own) {
  std::filesystem::create_directory(folder / "parts");
  H5File part = H5File::replacing(folder / "parts/a.h5");
  part.mark("/", "time", 0.25);
  part.write("/values", std::vector<double>{1, 2}, {2});
  part.publish(Durable::after_sync);
  H5File whole = H5File::replacing(path);
  whole.link("/steps/000000", "parts/a.h5");
  whole.publish(Durable::after_sync);
  const H5File file = H5File::read(path);
  EXPECT_EQ(file.list("/steps"), std::vector<std::string>{"000000"});
  EXPECT_EQ(file.attribute("/steps/000000", "time"), 0.25);
  EXPECT_EQ(file.doubles("/steps/000000/values"), (std::vector<double>{1, 2}));
  EXPECT_FALSE(file.has("/nothing/there"));
}

TEST_F(H5FileTest, a_file_stays_as_it_is_while_another_is_written_that_will_replace_it) {
  H5File first = H5File::replacing(path);
  first.append("/rows", std::vector{1.}, {});
  EXPECT_FALSE(std::filesystem::exists(path));
  first.publish(Durable::now);
  const H5File opened = H5File::read(path);
  H5File second = H5File::revising(path);
  second.append("/rows", std::vector{2.}, {});
  EXPECT_EQ(H5File::read(path).doubles("/rows"), std::vector{1.});
  second.publish(Durable::now);
  EXPECT_EQ(H5File::read(path).doubles("/rows"), (std::vector{1., 2.}));
  EXPECT_EQ(opened.doubles("/rows"), std::vector{1.}) << "a reader keeps what it opened";
  EXPECT_FALSE(std::filesystem::exists(temporary_name(path)));
}

TEST_F(H5FileTest, files_with_the_same_content_are_the_same_whenever_they_were_written) {
  const auto written = [this] {
    {
      H5File file = H5File::replacing(path);
      file.write("/a/values", std::vector<double>{1, 2}, {2});
      file.append("/rows", std::vector<double>{3}, {1});
      file.mark("/a", "mark", 4);
      file.publish(Durable::after_sync);
    }
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string first = written();
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 counts seconds
  EXPECT_EQ(written(), first);
}

TEST_F(H5FileTest, a_damaged_file_is_refused_with_its_name) {
  std::ofstream(path) << "this is not HDF5";
  try {
    H5File::read(path);
    FAIL() << "it was taken";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
  }
}

TEST_F(H5FileTest, a_shape_that_does_not_fit_is_refused) {
  H5File file = H5File::replacing(path);
  EXPECT_THROW(file.write("/values", std::vector<double>{1, 2, 3}, {2, 2}), Error);
  EXPECT_THROW(file.append("/rows", std::vector<double>{1, 2, 3}, {2}), Error);
}

TEST_F(H5FileTest, a_missing_array_or_folder_is_an_error) {
  EXPECT_THROW(H5File::replacing(folder / "nowhere/file.h5"), Error);
  EXPECT_THROW(H5File::replacing(path).doubles("/values"), Error);
}

}  // namespace
}  // namespace fpi::output
