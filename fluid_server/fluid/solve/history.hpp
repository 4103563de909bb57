/// The flow of earlier steps along the paths of a step: at nodes for the guess, and at quadrature points for
/// the inertia, where no interpolation onto the new mesh comes in between.
#pragma once

#include "fluid/solve/time_scheme.hpp"

namespace fpi::fluid {

/// Whether a node has moved neither in this step nor in the last.
bool stays(const Vector& displacement, const State& state, Index node);

/// The state at the places that the nodes came from.
State along_paths(const Space& space, const Vector& displacement, const State& state);

/// Takes the history of cells whose nodes move, in this step or the last, point by point.
void follow_paths(const System& system, const Vector& displacement, const State& state, const Scheme& scheme,
                  TimeTerms& terms);

}  // namespace fpi::fluid
