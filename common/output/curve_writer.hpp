/// boundaries.h5 and profiles.h5: values along named curves at every written step, a group a curve.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "output/step_series.hpp"

namespace fpi::output {

struct CurveView {
  std::string name;
  std::span<const double> points;        ///< [m] x, y, z of each
  std::span<const std::uint32_t> lines;  ///< 3 points each: both ends, then the middle; may be empty
  std::size_t components = 1;
  std::span<const double> values;  ///< components of each point, one after another
};

class CurveWriter {
 public:
  /// `quantity` names the array of values.
  CurveWriter(const std::string& path, std::string quantity)
      : series_(path), quantity_(std::move(quantity)) {}
  /// Continues the file at `path` after its first `kept` steps.
  CurveWriter(const std::string& path, std::string quantity, std::size_t kept)
      : series_(path, kept), quantity_(std::move(quantity)) {}

  void write(double time, std::span<const CurveView> curves);
  std::size_t size() const { return series_.size(); }

 private:
  StepSeries series_;
  std::string quantity_;
};

}  // namespace fpi::output
