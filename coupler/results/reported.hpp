/// What is reported with every step besides the bodies: probes, loads of boundaries, drag and lift, energies.
#pragma once

#include <string>
#include <vector>

#include "step/coupled_problem.hpp"

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
  std::vector<double> drives;    ///< [Pa/m or Pa] in the order of `found_drives`
  std::vector<double> energies;  ///< [J] of the grains, where the scene keeps an account
};

/// The named boundaries on which the velocity is given, wholly or in part.
std::vector<std::string> holding_boundaries(const scene::Scene& scene);

/// Names of what the fluid finds for the flows that the scene gives: the fall of the mean pressure, the
/// pressure at a boundary.
std::vector<std::string> found_drives(const scene::Scene& scene);

/// Whether the grains' energies are written.
inline bool has_energies(const scene::Scene& scene) {
  return scene.needs_dem() && scene.dem && scene.dem->energy;
}

/// Name of the column of a coefficient, "drag" or "lift".
std::string column_of(const scene::Coefficients& coefficients, const std::string& quantity);

/// Of the last accepted step. Throws Error for a boundary force that the scene needs and the fluid did not
/// report.
Reported reported(const scene::Scene& scene, const CoupledProblem& problem);

}  // namespace fpi
