/// How strongly a fluid resists a change of a body's velocity at the end of a step, seen as inertia added to
/// the body's own: with it the coupling converges at any density ratio, and contacts inside a step feel the
/// fluid around the body.
#pragma once

#include <Eigen/Core>

#include "coupling/rigid_dofs.hpp"
#include "scene/fluid.hpp"

namespace fpi::coupling {

/// Of a disc of radius R that starts to move in a viscous fluid, per length [kg/m], and to turn [kg m]: the
/// force −S ΔV of the unsteady Stokes flow (Stokes' oscillating cylinder at the frequency i/τ) over a step
/// Δt, S Δt with z = R/√(ντ): ρπR² (Δt/τ) (1 + 4 K₁(z)/(z K₀(z))) and 2πμR² Δt (2 + z K₀(z)/K₁(z)).
struct AddedInertia {
  double mass = 0, inertia = 0;
};
/// `density` [kg/m³], `viscosity` μ [Pa s], `radius` that the fluid sees [m]; `tau` = γΔt of the fluid's
/// scheme and the step Δt [s], all > 0.
AddedInertia added_inertia(double density, double viscosity, double radius, double tau, double time_step);

/// Of each unknown of the coupling, as RigidDofs orders them, in a step of Δt [s].
Eigen::VectorXd added_inertia(const RigidDofs& dofs, const scene::Fluid& fluid, double hydraulic_radius_ratio,
                              double time_step);

/// m_f of the fluid that each body displaces [kg]; 0 of spins.
Eigen::VectorXd displaced_mass(const RigidDofs& dofs, const scene::Fluid& fluid,
                               double hydraulic_radius_ratio);

}  // namespace fpi::coupling
