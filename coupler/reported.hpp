/// What is reported with every step besides the bodies: probes, loads of boundaries, drag and lift.
#pragma once

#include <string>
#include <vector>

#include "simulation.hpp"

namespace fpi {

/// c = 2F/(ρ U² L thickness) of a body or a boundary: F_x for drag, F_y for lift.
struct DragLift {
  double drag = 0, lift = 0;
};

/// What the fluid does to a named boundary that holds it.
struct BoundaryLoad {
  double fx = 0, fy = 0;  ///< [N]
  double torque = 0;      ///< about its centre [N m]
};

/// In the order of the scene; NaN where the fluid has no value.
struct Reported {
  std::vector<double> probes;
  std::vector<BoundaryLoad> boundaries;  ///< in the order of `holding_boundaries`
  std::vector<DragLift> coefficients;
};

/// The named boundaries on which the velocity is given, wholly or in part.
std::vector<std::string> holding_boundaries(const scene::Scene& scene);

/// Name of the column of a coefficient, "drag" or "lift".
std::string column_of(const scene::Coefficients& coefficients, const std::string& quantity);

/// Of the last accepted step. Throws Error for a boundary force that the scene needs and the fluid did not
/// report.
Reported reported(const scene::Scene& scene, const Simulation& simulation);

}  // namespace fpi
