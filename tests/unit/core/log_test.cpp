/// The log of a process.
#include "core/log.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.hpp"

namespace fpi {
namespace {

TEST(Log, writes_name_level_and_text_to_its_file) {
  const std::string file = testing::TempDir() + "fpi_log_test.log";
  std::filesystem::remove(file);
  log::open("tester", file, log::Level::error);
  log::warning("gap of {} m", 0.5);
  log::flush();
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_NE(text.str().find("tester warning: gap of 0.5 m"), std::string::npos) << text.str();
  std::filesystem::remove(file);
}

TEST(Log, says_which_file_cannot_be_written) {
  try {
    log::open("tester", "/proc/no/such/folder.log", log::Level::error);
    FAIL() << "opened";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("/proc/no/such/folder.log"), std::string::npos);
  }
}

}  // namespace
}  // namespace fpi
