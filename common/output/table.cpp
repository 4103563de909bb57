#include "output/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "core/error.hpp"

namespace fpi::output {
namespace {

/// Where the line after the header and `rows` more begins. Throws Error where the file has fewer.
std::uintmax_t end_of_row(const std::string& path, std::size_t rows) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (std::size_t i = 0; i <= rows; ++i) {
    require(std::getline(file, line) && !file.eof(),
            "a table of a header and {} lines is required in {}; it ends after {}: the file does not belong "
            "to the "
            "checkpoint",
            rows, path, i);
  }
  return static_cast<std::uintmax_t>(file.tellg());
}

}  // namespace

Table::Table(const std::string& path, const std::vector<std::string>& columns)
    : path_(path), file_(path, std::ios::binary) {
  write_line(fmt::format("{}", fmt::join(columns, ",")));
}

Table::Table(const std::string& path, std::size_t kept) : path_(path), rows_(kept) {
  std::filesystem::resize_file(path, end_of_row(path, kept));
  file_.open(path, std::ios::binary | std::ios::app);
}

void Table::append(std::span<const double> values) {
  write_line(fmt::format("{}", fmt::join(values, ",")));
  ++rows_;
}

void Table::write_line(const std::string& line) {
  file_ << line << '\n' << std::flush;
  require(file_.good(), "a file that can be written is required for {}: check the folder and its free space",
          path_);
}

}  // namespace fpi::output
