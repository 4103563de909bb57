/// Keeps the momentum of the fluid around bodies that move. Old velocities that are looked up along paths,
/// and convection by a flow whose divergence vanishes in the mean only, change it by a little of the order of
/// the scheme; that little is found as the solution is, and given back, evenly over the cells that move
/// (docs/numerics.md, "Momentum").
#pragma once

#include "fluid/discretisation/system.hpp"
#include "fluid/solve/time_scheme.hpp"

namespace fpi::fluid {

/// The fluid in each cell: its area [m²] and ∫u [m³/s], x and y; zeros where there is none.
Vector fluid_in_cells(const System& system, const Vector& u);

/// The parts of the mesh that move in the step or moved in the last one, no two of which share a node that
/// does, and how much momentum the inertia of `time`, which has its history, makes there. Paths take such a
/// part onto itself, so what its fluid had before is in the same cells. Without parts whose fluid is another
/// one now, where a pore closed or a body came or left.
std::vector<MovingPart> moving_parts(const System& system, const Vector& displacement, const State& accepted,
                                     const Scheme& scheme, const TimeTerms& time);

}  // namespace fpi::fluid
