/// What the scene asks to be reported with every step besides the bodies: probes, drag and lift.
#pragma once

#include <optional>
#include <vector>

#include "simulation.hpp"

namespace fpi {

/// c = 2F/(ρ U² L thickness) of a body or a boundary: F_x for drag, F_y for lift.
struct DragLift {
  double drag = 0, lift = 0;
};

struct Reported {
  std::vector<double> probes;            ///< in the order of the scene; NaN where the fluid has no value
  std::optional<DragLift> coefficients;  ///< where the scene asks for them
};

/// Of the last accepted step. Throws Error for a boundary force that the fluid did not report.
Reported reported(const scene::Scene& scene, const Simulation& simulation);

}  // namespace fpi
