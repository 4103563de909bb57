/// What is asked of a flow through grains: integrals over the fluid that make porosity, velocities,
/// tortuosity and wetted surface, and how pressure and speed are distributed. Uses the quadrature of the
/// discrete equations, so that cut elements count with their fluid part.
#pragma once

#include <vector>

#include "fluid/discretisation/system.hpp"

namespace fpi::fluid {

/// Over the fluid; `box` is the rectangle around the mesh.
struct PoreFlow {
  double box = 0;                      ///< [m²]
  double fluid = 0;                    ///< area of the fluid [m²]
  double surface = 0;                  ///< wetted surface of the bodies [m]
  Vec2 flux = Vec2::Zero();            ///< ∫u [m³/s a metre of thickness]
  Vec2 flux_of_bodies = Vec2::Zero();  ///< ∫ of their velocities, over what of them is in the box
  double speed = 0;                    ///< ∫|u|
  double largest_speed = 0;            ///< met at a quadrature point [m/s]

  double porosity() const { return fluid / box; }
  double specific_surface() const { return surface / box; }  ///< wetted, over the whole volume [1/m]
  Vec2 superficial_velocity() const { return (flux + flux_of_bodies) / box; }  ///< bodies included [m/s]
  Vec2 pore_velocity() const { return flux / fluid; }                          ///< [m/s]
  /// ⟨|u|⟩/⟨u_axis⟩: the length of the way over that of the bed.
  double tortuosity(int axis) const { return speed / flux[axis]; }
};
PoreFlow pore_flow(const System& system, const Vector& u);

/// Means over a slab across the flow.
struct Section {
  double place = 0;  ///< of its middle along the axis [m]
  double porosity = 0;
  double pressure = 0;  ///< mean over its fluid [Pa]
  double velocity = 0;  ///< superficial, along the axis, bodies included [m/s]
};
/// `n` slabs across an axis, in which the mean pressure falls by `drop` a metre besides [Pa/m].
std::vector<Section> sections(const System& system, const Vector& u, const Vector& p, int axis, int n,
                              double drop);

/// Share of the fluid's volume with a velocity along the axis between two bounds.
struct SpeedBin {
  double from = 0, to = 0;  ///< [m/s]
  double share = 0;
};
std::vector<SpeedBin> speed_histogram(const System& system, const Vector& u, int axis, int n);

/// k of Darcy's law U = k/μ · (−∇p) at vanishing Reynolds number [m²], from a solve for each axis with the
/// factor of the Stokes equations: entry (i, j) is U_i for a fall along j. Axes that are not periodic have
/// zeros.
Eigen::Matrix2d permeability(const System& system, const Factor& stokes, double viscosity);

}  // namespace fpi::fluid
