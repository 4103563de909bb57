/// interface.h5: the multipliers on the arcs or edges of every body at every written step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "output/step_series.hpp"

namespace fpi::output {

/// All arcs (or edges) of all bodies, one after another.
struct InterfaceArrays {
  std::vector<std::uint32_t> body;  ///< of each arc
  std::vector<double> start, end;   ///< [rad] of each arc; NaN of edges
  std::vector<double> middle;       ///< [m] x, y of each arc
  std::vector<double> traction;     ///< [Pa] x, y of each arc
  std::vector<double> centre;       ///< [m] x, y of each body
};

class InterfaceWriter {
 public:
  explicit InterfaceWriter(const std::string& folder) : series_(folder + "/interface.h5") {}
  /// Continues the file in `folder` after its first `kept` steps.
  InterfaceWriter(const std::string& folder, std::size_t kept) : series_(folder + "/interface.h5", kept) {}

  void write(double time, const InterfaceArrays& arrays);
  std::size_t size() const { return series_.size(); }

 private:
  StepSeries series_;
};

}  // namespace fpi::output
