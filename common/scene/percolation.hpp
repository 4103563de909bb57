/// [percolation]: asks for what is wanted of a flow through grains; the fluid reads it.
#pragma once

#include <array>
#include <string>

#include "core/parameters.hpp"

namespace fpi::scene {

struct Percolation {
  std::string direction = "x";  ///< of the flow
  std::int64_t sections = 20;   ///< slabs across it that means are taken over
  std::int64_t bins = 50;       ///< of the histogram of velocities

  static constexpr std::array<std::string_view, 2> directions{"x", "y"};

  void declare(ParameterVisitor& v) {
    v.choice({"direction", "", "axis along which the fluid is to flow"}, direction, directions);
    v.integer({"sections", "", "slabs across the flow that means are taken over, of sections.csv"}, sections,
              between(1, 10000));
    v.integer({"bins", "", "intervals of the histogram of velocities, of velocities.csv"}, bins,
              between(1, 10000));
  }
};

}  // namespace fpi::scene
