/// What a scene asks to be measured in the accepted flow, as parts of messages; forces are those of the
/// scene's whole thickness.
#pragma once

#include "fluid/navier_stokes.hpp"
#include "proto/messages.hpp"
#include "scene/scene.hpp"

namespace fpi::fluid {

/// Where the scene puts a body, as the fluid sees it.
Surface surface(const scene::Body& body, double hydraulic_radius_ratio);
std::vector<Vec2> to_points(const std::vector<double>& coordinates);

/// Errors: each probe and profile outside the mesh. Warnings: each probe in a body.
void check_places(const scene::Scene& scene, const Mesh& mesh, const Locator& locator, Findings& findings);

/// With every accepted step: probes by name, and "force_x:NAME", "force_y:NAME" [N], "torque:NAME" [N m] of
/// the boundaries that hold the fluid; "pressure_drop_x", "pressure_drop_y" [Pa/m] and "pressure_at_NAME"
/// [Pa] that a given flow takes.
proto::Figures step_figures(const scene::Scene& scene, const NavierStokes& solver);

/// At the end: "centre_x:NAME", "centre_y:NAME" [m] that torques of boundaries are about; of each profile
/// "min:NAME", "min_x:NAME", "min_y:NAME" and the same for max; "error:velocity_l2", "error:velocity_h1",
/// "error:pressure_l2" against the exact solution.
proto::Figures final_figures(const scene::Scene& scene, const NavierStokes& solver);

/// "balance_x:TERM", "balance_y:TERM" [N], and "balance:rest", what they add up to over the largest.
proto::Figures balance_figures(double thickness, const ForceBalance& balance);
/// "volume:TERM" [m³/s] into the fluid, and "volume:rest", what they add up to.
proto::Figures volume_figures(double thickness, const VolumeBalance& balance);

/// Traction [Pa] on the boundaries that hold the fluid; none before the first accepted step.
std::vector<proto::Curve> boundary_curves(const NavierStokes& solver);
std::vector<proto::Curve> profile_curves(const scene::Scene& scene, const NavierStokes& solver);

}  // namespace fpi::fluid
