#include "grains/table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "core/error.hpp"
#include "core/number.hpp"
#include "core/utf8.hpp"

namespace fpi::grains {
namespace {

/// A column's name and where its numbers go.
struct Column {
  std::string_view name;
  double& (*place)(Row&);
  bool required;
};

double& x(Row& row) { return row.sphere.centre[0]; }
double& y(Row& row) { return row.sphere.centre[1]; }
double& z(Row& row) { return row.sphere.centre[2]; }
double& radius(Row& row) { return row.sphere.radius; }
double& vx(Row& row) { return row.velocity[0]; }
double& vy(Row& row) { return row.velocity[1]; }
double& vz(Row& row) { return row.velocity[2]; }
double& spin_x(Row& row) { return row.spin[0]; }
double& spin_y(Row& row) { return row.spin[1]; }
double& spin_z(Row& row) { return row.spin[2]; }

std::vector<Column> known_columns(std::size_t axes) {
  std::vector<Column> known{
      {"x", x, true}, {"y", y, true}, {"radius", radius, true}, {"vx", vx, false}, {"vy", vy, false}};
  if (axes == 2) {
    known.push_back({"spin", spin_z, false});
  } else {
    known.insert(known.end(), {{"z", z, true},
                               {"vz", vz, false},
                               {"spin_x", spin_x, false},
                               {"spin_y", spin_y, false},
                               {"spin_z", spin_z, false}});
  }
  return known;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Cuts the first line off `text`, whatever system it is from.
std::string_view next_line(std::string_view& text) {
  const std::size_t at = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, at);
  text.remove_prefix(at);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text.size()));
  return without_blanks(line);
}

/// Cuts the first cell off a line; blanks and quotes around it are dropped.
std::string_view next_cell(std::string_view& line) {
  const std::size_t at = std::min(line.find(','), line.size());
  std::string_view cell = without_blanks(line.substr(0, at));
  line.remove_prefix(std::min(at + 1, line.size()));
  if (cell.size() > 1 && cell.starts_with('"') && cell.ends_with('"')) cell = cell.substr(1, cell.size() - 2);
  return cell;
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  while (!line.empty()) out.push_back(next_cell(line));
  return out;
}

/// A table of other separators has one column, whose name holds them.
void require_commas(std::string_view header, const std::string& file) {
  for (const auto& [separator, name] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")})
    require(header.find(separator) == std::string_view::npos || header.find(',') != std::string_view::npos,
            "{}:1: columns separated by commas are required; got {}: write commas between the columns, and "
            "decimal "
            "points in the numbers",
            file, name);
}

std::string hint(std::string_view name, const std::vector<std::string_view>& names) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::string near = did_you_mean(lower, names);
  const bool is_likely = near == lower || lower.size() > 2;  // any letter is near another one
  return near.empty() || !is_likely ? "" : fmt::format(" (did you mean \"{}\"?)", near);
}

std::vector<Column> read_header(std::string_view line, const std::string& file, std::size_t axes) {
  const std::vector<Column> known = known_columns(axes);
  std::vector<std::string_view> names;
  std::ranges::transform(known, std::back_inserter(names), &Column::name);
  require_commas(line, file);
  std::vector<Column> columns;
  for (const std::string_view name : cells(line)) {
    const auto found = std::ranges::find(known, name, &Column::name);
    require(found != known.end(),
            "{}:1, column {}: a column must be one of {}; got \"{}\"{}: correct its name or remove it", file,
            columns.size() + 1, fmt::join(names, ", "), printable(name), hint(name, names));
    require(std::ranges::find(columns, name, &Column::name) == columns.end(),
            "{}:1, column {}: a column must be given once; got \"{}\" again: remove one", file,
            columns.size() + 1, name);
    columns.push_back(*found);
  }
  for (const Column& column : known)
    require(!column.required || std::ranges::find(columns, column.name, &Column::name) != columns.end(),
            "{}:1: the first line must name the columns and among them \"{}\"; got \"{}\": add it", file,
            column.name, printable(line));
  return columns;
}

double read_number(std::string_view cell, const std::string& file, std::size_t line, std::size_t column,
                   const Column& of) {
  const auto value = to_number<double>(cell);
  const bool is_radius = of.name == "radius";
  require(value && std::abs(*value) <= largest_real && (!is_radius || *value >= smallest_positive_real),
          "{}:{}, column {} ({}): a finite number{} is required; got \"{}\": correct it", file, line, column,
          of.name, is_radius ? " > 0 m" : "", printable(cell));
  return *value;
}

}  // namespace

Table read_table(std::string_view text, const std::string& file, std::size_t axes) {
  require_utf8(text, file);
  text = without_byte_order_mark(text);
  const std::vector<Column> columns = read_header(next_line(text), file, axes);
  const auto has = [&columns](std::string_view prefix) {
    return std::ranges::any_of(columns, [prefix](const Column& c) { return c.name.starts_with(prefix); });
  };
  Table table{.rows = {}, .has_velocity = has("v"), .has_spin = has("spin")};
  for (std::size_t line = 2; !text.empty(); ++line) {
    const std::string_view row = next_line(text);
    if (row.empty()) continue;
    const std::vector<std::string_view> values = cells(row);
    require(values.size() == columns.size(),
            "{}:{}: a number for each of {} columns is required; got {}: correct the line{}", file, line,
            columns.size(), values.size(),
            values.size() > columns.size() ? "; decimals take a point, a comma ends a column" : "");
    Row& out = table.rows.emplace_back();
    for (std::size_t c = 0; c < columns.size(); ++c)
      columns[c].place(out) = read_number(values[c], file, line, c + 1, columns[c]);
  }
  require(!table.rows.empty(), "{}: a line for each grain is required after the first; got none: add them",
          file);
  return table;
}

}  // namespace fpi::grains
