/// The way to a steady flow: from Stokes flow by Newton's iteration; where that stalls, by way of flows with
/// a part of the convection, which is a continuation in the Reynolds number.
#pragma once

#include "fluid/solve/newton.hpp"

namespace fpi::fluid {

/// Improves `iterate`, whose velocities meet the boundary conditions, to the steady flow. Where none is found
/// the reason says up to which part of the Reynolds number one was, and where the equations are worst met
/// beyond.
NewtonResult solve_steady(System& system, const Flow& flow, const scene::Newton& parameters, Iterate& iterate,
                          Profiler& monitor);

}  // namespace fpi::fluid
