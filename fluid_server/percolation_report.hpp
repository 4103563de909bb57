/// What a scene with [percolation] gets to know of the accepted flow, as parts of messages.
#pragma once

#include "fluid/navier_stokes.hpp"
#include "proto/messages.hpp"
#include "scene/scene.hpp"

namespace fpi::fluid {

/// "percolation:NAME" of each figure (docs/percolation.md lists them); empty where the scene does not ask.
proto::Figures percolation_figures(const scene::Scene& scene, NavierStokes& solver);

/// "percolation:permeability_xx" and so on, along periodic axes, of a steady scene that asks: it may take a
/// factor of its own, so longer than a participant has for its last words.
proto::Figures permeability_figures(const scene::Scene& scene, NavierStokes& solver);

/// "sections", "velocities" and "grains".
std::vector<proto::Sheet> percolation_tables(const scene::Scene& scene, const NavierStokes& solver);

}  // namespace fpi::fluid
