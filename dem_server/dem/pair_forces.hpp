/// Forces of the contacts between bodies: distances of listed pairs are looked at several at once, and those
/// that touch go through the contact law several at once.
#pragma once

#include "dem/pair_memories.hpp"

namespace fpi::dem {

/// The sub-step that pairs are evaluated at the end of. Springs stretch at the rates of `now`, by the
/// trapezoidal rule: half at the end of a sub-step, half at the start of the next.
struct PairStep {
  double before;    ///< [s] that springs have stretched for since they were left
  double after;     ///< [s] that they are stretched for in advance
  double elapsed;   ///< [s] since the forces were found that `now` is extrapolated by
  double duration;  ///< [s] that the normal damping is averaged over
  double reach;     ///< [m] the gap that nothing closes within half of it
};

/// Adds the forces of all pairs to `particles.push`. The sums do not depend on the number of threads: a pair
/// belongs to the slab of its lower particle, and even slabs come first, then odd ones.
ContactCount add_pair_forces(const Model& model, const Neighbours& neighbours, const PairStep& step,
                             PairMemories& memories, Particles& particles);

}  // namespace fpi::dem
