/// Forces along the line of centres that need no contact and keep energy: the near field of paper eq. (22),
/// f = κ₁ d^(−a₁) − κ₂ d^(−a₂) towards the other body up to a cut-off distance d of the centres; and the pull
/// of adhesion, JKR's 3/2 π w R* while surfaces touch, which falls linearly to zero with the gap.
#pragma once

#include "dem/contact/contact.hpp"
#include "dem/contact/state.hpp"

namespace fpi::dem {

/// Of one pair of surfaces; > 0 pulls them together [N].
double attraction(const Model& model, const Near& near);
/// Work that it takes to part them [J] is minus this; zero out of reach.
double attraction_energy(const Model& model, const Near& near);
/// No stiffness dF/dd of the pair is larger while it does not overlap [N/m].
double attraction_stiffness(const Model& model, const Near& near);
/// The gap within which a pair acts on each other [m]; negative where there is no such force.
double attraction_reach(const Model& model, const Near& near);
/// The widest such gap of any pair [m]; 0 where there is none.
double widest_attraction(const Model& model);

/// Adds the attractions of all that is near to `forces`, and to those that `count` records.
void add_attractions(const Model& model, const State& state, Forces& forces, ContactCount& count);

}  // namespace fpi::dem
