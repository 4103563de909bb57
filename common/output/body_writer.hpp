/// bodies.h5: the motion of every body and what acts on it, a row a step.
#pragma once

#include <array>
#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "output/h5_file.hpp"

namespace fpi::output {

/// One body at one time, NaN where it is no longer there; z components are zero in the plane, except of spin and torque.
struct BodyRow {
  std::array<double, 3> position{};  ///< [m]
  std::array<double, 3> rotation{};  ///< from the start: axis times angle, −π to π [rad]
  std::array<double, 3> velocity{};  ///< [m/s]
  std::array<double, 3> spin{};      ///< [rad/s]
  std::array<double, 3> force{};     ///< [N] from the fluid
  std::array<double, 3> torque{};    ///< [N m] from the fluid, about the centre
};

class BodyWriter {
 public:
  /// A new file; at least one body.
  BodyWriter(const std::string& folder, const std::vector<std::string>& names,
             const std::vector<double>& radii);
  /// Continues the file in `folder` after its first `kept` rows.
  BodyWriter(const std::string& folder, std::size_t kept);

  /// Adds a row; all rows older than a second are in the file, whatever happens to this process.
  void append(double time, std::span<const BodyRow> bodies);
  /// Brings all rows into the file.
  void flush();
  std::size_t size() const { return rows_; }

 private:
  H5File file_;
  std::size_t rows_ = 0;
  std::chrono::steady_clock::time_point flushed_{};
};

}  // namespace fpi::output
