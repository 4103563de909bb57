/// Forces of the contacts between bodies: distances of listed pairs are looked at several at once, and those
/// that touch go through the contact law several at once.
#pragma once

#include "dem/contact/pair_histories.hpp"

namespace fpi::dem {

/// Adds the forces of all pairs to `particles.force`. The sums do not depend on the number of threads: a pair
/// belongs to the slab of its lower particle, and even slabs come first, then odd ones.
ContactCount add_pair_forces(const Model& model, const Neighbours& neighbours, const SubStep& step,
                             PairHistories& histories, Particles& particles);

}  // namespace fpi::dem
