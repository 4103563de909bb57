/// The text of an XDMF file: which arrays of fields.h5 are points, cells and fields, at which times.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace fpi::output {

struct XdmfField {
  std::string name;
  bool on_cells = false;
  std::size_t components = 1;  ///< 1: scalar; 2: plane vector
};
struct XdmfLayout {
  std::size_t points = 0, cells = 0;
  std::vector<XdmfField> fields;
};

/// A temporal collection of one mesh of quadratic triangles; `times` [s], one a step.
std::string xdmf_text(const XdmfLayout& layout, std::span<const double> times);

}  // namespace fpi::output
