#include "grains/table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/error.hpp"

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

/// Cuts the next piece, up to `end` or the end of the text, off the front of `text`; blanks around it are
/// dropped.
std::string_view next_piece(std::string_view& text, char end) {
  const std::size_t at = std::min(text.find(end), text.size());
  std::string_view piece = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  const std::size_t first = piece.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return piece.substr(first, piece.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  while (!line.empty()) out.push_back(next_piece(line, ','));
  return out;
}

std::vector<Column> read_header(std::string_view line, const std::string& file, std::size_t axes) {
  const std::vector<Column> known = known_columns(axes);
  std::vector<std::string_view> names;
  std::ranges::transform(known, std::back_inserter(names), &Column::name);
  std::vector<Column> columns;
  for (const std::string_view name : cells(line)) {
    const auto found = std::ranges::find(known, name, &Column::name);
    require(found != known.end(),
            "{}:1, column {}: a column must be one of {}; got \"{}\": correct its name or remove it", file,
            columns.size() + 1, fmt::join(names, ", "), name);
    require(std::ranges::find(columns, name, &Column::name) == columns.end(),
            "{}:1, column {}: a column must be given once; got \"{}\" again: remove one", file,
            columns.size() + 1, name);
    columns.push_back(*found);
  }
  for (const Column& column : known)
    require(!column.required || std::ranges::find(columns, column.name, &Column::name) != columns.end(),
            "{}:1: the first line must name the columns and among them \"{}\"; got \"{}\": add it", file,
            column.name, line.substr(0, 80));
  return columns;
}

double read_number(std::string_view cell, const std::string& file, std::size_t line, std::size_t column,
                   const Column& of) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool good = error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value);
  const bool is_radius = of.name == "radius";
  require(good && (!is_radius || value > 0),
          "{}:{}, column {} ({}): a finite number{} is required; got \"{}\": correct it", file, line, column,
          of.name, is_radius ? " > 0 m" : "", cell.substr(0, 60));
  return value;
}

}  // namespace

Table read_table(std::string_view text, const std::string& file, std::size_t axes) {
  const std::vector<Column> columns = read_header(next_piece(text, '\n'), file, axes);
  const auto has = [&columns](std::string_view prefix) {
    return std::ranges::any_of(columns, [prefix](const Column& c) { return c.name.starts_with(prefix); });
  };
  Table table{.rows = {}, .has_velocity = has("v"), .has_spin = has("spin")};
  for (std::size_t line = 2; !text.empty(); ++line) {
    const std::string_view row = next_piece(text, '\n');
    if (row.empty()) continue;
    const std::vector<std::string_view> values = cells(row);
    require(values.size() == columns.size(),
            "{}:{}: a number for each of {} columns is required; got {}: correct the line", file, line,
            columns.size(), values.size());
    Row& out = table.rows.emplace_back();
    for (std::size_t c = 0; c < columns.size(); ++c)
      columns[c].place(out) = read_number(values[c], file, line, c + 1, columns[c]);
  }
  require(!table.rows.empty(), "{}: a line for each grain is required after the first; got none: add them",
          file);
  return table;
}

}  // namespace fpi::grains
