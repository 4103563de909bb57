/// bodies.h5: the motion of every body and what acts on it, a row a step.
#pragma once

#include <array>
#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "output/h5_file.hpp"

namespace fpi::output {

/// One body at one time, NaN where it is no longer there; z components are zero in the plane, except of spin
/// and torque.
struct BodyRow {
  std::array<double, 3> position{};  ///< [m]
  std::array<double, 3> rotation{};  ///< from the start: axis times angle, −π to π [rad]
  std::array<double, 3> velocity{};  ///< [m/s]
  std::array<double, 3> spin{};      ///< [rad/s]
  std::array<double, 3> force{};     ///< [N] from the fluid
  std::array<double, 3> torque{};    ///< [N m] from the fluid, about the centre
};

/// The file is replaced by one with more rows once a second, less often where it is so large that this would
/// take more than a hundredth of the time.
class BodyWriter {
 public:
  /// A new file; at least one body.
  BodyWriter(const std::string& folder, const std::vector<std::string>& names,
             const std::vector<double>& radii);
  /// Continues the file in `folder` after its first `kept` rows.
  BodyWriter(const std::string& folder, std::size_t kept);

  /// Adds a row, which is in the file after the next flush, or before.
  void append(double time, std::span<const BodyRow> bodies);
  /// Brings all rows into the file.
  void flush();
  std::size_t size() const { return in_file_ + times_.size(); }

 private:
  std::string path_;
  std::size_t in_file_ = 0;
  std::vector<double> times_;  ///< [s] of the rows that are not in the file
  std::vector<BodyRow> rows_;  ///< of all bodies at each of these times
  std::chrono::steady_clock::time_point next_flush_{};
};

}  // namespace fpi::output
