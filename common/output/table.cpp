#include "output/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "core/error.hpp"
#include "output/replace.hpp"

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

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
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

void write_table(const std::string& path, const std::vector<std::string>& columns,
                 std::span<const double> values) {
  require(!columns.empty() && values.size() % columns.size() == 0,
          "lines of as many numbers as there are columns are required for {}; got {} numbers for {} columns",
          path, values.size(), columns.size());
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (std::size_t row = 0; row < values.size(); row += columns.size())
    text += fmt::format("{}\n", fmt::join(values.subspan(row, columns.size()), ","));
  replace_text(path, text);
}

Columns read_columns(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  require(std::getline(file, line) && !file.eof(), "a table with a header is required in {}; got none", path);
  const std::vector<std::string> names = split(line);
  Columns columns;
  for (const std::string& name : names) columns[name];
  while (std::getline(file, line) && !file.eof()) {
    const std::vector<std::string> cells = split(line);
    require(cells.size() == names.size(), "{} must have {} numbers a line; got {} in \"{}\"", path,
            names.size(), cells.size(), line);
    for (std::size_t i = 0; i < names.size(); ++i)
      columns[names[i]].push_back(std::strtod(cells[i].c_str(), nullptr));
  }
  return columns;
}

}  // namespace fpi::output
