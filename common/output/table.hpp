/// A table of numbers as text, a line a step (history.csv). Every line is handed to the operating system at
/// once.
#pragma once

#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace fpi::output {

class Table {
 public:
  /// A new table.
  Table(const std::string& path, const std::vector<std::string>& columns);
  /// Continues the table at `path` after its first `kept` lines of numbers; throws Error where it has fewer.
  Table(const std::string& path, std::size_t kept);

  /// One line; numbers are written so that reading them gives the same bits.
  void append(std::span<const double> values);
  std::size_t size() const { return rows_; }

 private:
  void write_line(const std::string& line);

  std::string path_;
  std::ofstream file_;
  std::size_t rows_ = 0;
};

/// Writes a whole table, `values` line by line, in the place of one that may be there. Throws Error.
void write_table(const std::string& path, const std::vector<std::string>& columns,
                 std::span<const double> values);

/// The numbers of a table by column.
using Columns = std::map<std::string, std::vector<double>>;

/// Reads a table back; a last line that is not whole is left out. Throws Error where it cannot be read.
Columns read_columns(const std::string& path);

}  // namespace fpi::output
