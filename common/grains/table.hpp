/// Grains from a table in CSV: a line a grain, the first line names the columns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "grains/sphere.hpp"

namespace fpi::grains {

struct Row {
  Sphere sphere;
  Vec3 velocity{};  ///< [m/s]
  Vec3 spin{};      ///< [rad/s]
};

struct Table {
  std::vector<Row> rows;
  bool has_velocity = false, has_spin = false;
};

/// Columns x, y (z in space), radius, and where given vx, vy (vz) and spin (spin_x, spin_y, spin_z), in any
/// order. Throws Error with file, line and column where the text is not such a table.
Table read_table(std::string_view text, const std::string& file, std::size_t axes);

}  // namespace fpi::grains
