/// fields.h5 and fields.xdmf: the fluid's mesh once, its fields at every written step. ParaView opens the
/// .xdmf, which names the arrays of the .h5 beside it, at any moment of a run.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "output/step_series.hpp"
#include "output/xdmf.hpp"

namespace fpi::output {

/// Components of each point or cell, one after another.
struct FieldView {
  std::string name;
  bool on_cells = false;
  std::size_t components = 1;
  std::span<const double> values;
};

class FieldWriter {
 public:
  explicit FieldWriter(const std::string& folder);
  /// Continues the files in `folder` after their first `kept` steps.
  FieldWriter(const std::string& folder, std::size_t kept);

  /// The mesh, once, before the first fields: x, y of each point and six points a quadratic triangle
  /// (corners, then the middles of sides 01, 12, 20).
  void write_mesh(std::span<const double> points, std::span<const std::uint32_t> cells);
  bool has_mesh() const { return layout_.points > 0; }

  /// The fields at `time` [s]; what was written before stays readable whatever happens.
  void write(double time, std::span<const FieldView> fields);
  std::size_t size() const { return series_.size(); }

 private:
  void read_layout();
  void write_xdmf() const;

  std::string folder_;
  StepSeries series_;
  XdmfLayout layout_;
};

}  // namespace fpi::output
