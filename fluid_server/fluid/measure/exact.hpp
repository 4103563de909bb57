/// Errors of a computed flow against an exact one, over the fluid domain.
#pragma once

#include <functional>

#include "fluid/base/state.hpp"
#include "fluid/cut/cut_mesh.hpp"

namespace fpi::fluid {

struct ExactFlow {
  std::function<Vec2(const Vec2&)> velocity;    ///< [m/s]
  std::function<double(const Vec2&)> pressure;  ///< [Pa]
};

/// Norms of the differences.
struct FlowErrors {
  double velocity_l2 = 0;  ///< [m²/s]
  double velocity_h1 = 0;  ///< of the gradient [m/s]
  double pressure_l2 = 0;  ///< [Pa m]
};

/// `without_level`: the pressure is known up to a constant, so the mean of its difference is taken off. The
/// exact gradient comes from differences of the velocity over 1e-4 of an element.
FlowErrors flow_errors(const Mesh& mesh, const CutMesh& cut, const State& state, const ExactFlow& exact,
                       bool without_level);

}  // namespace fpi::fluid
