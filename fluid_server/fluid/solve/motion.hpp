/// How far the nodes of the mesh go with the bodies in a step: those on a body all the way, those far from
/// any not at all, those in between part of it. Along such paths the flow beside a body changes smoothly,
/// whatever the step, and comes from where there was fluid (docs/numerics.md, "Bodies that move").
#pragma once

#include <span>

#include "fluid/base/state.hpp"
#include "fluid/discretisation/space.hpp"
#include "fluid/geometry/interface.hpp"

namespace fpi::fluid {

BodyPlace place_of(const Interface& interface);

/// x, y of each node: its place minus where its path was at the start of the step [m]. Bodies that are not in
/// `before` come from where their velocity puts them. Nodes on the outer boundary stay.
Vector displacement(const Space& space, std::span<const Interface> interfaces,
                    std::span<const BodyPlace> before, double time_step);

}  // namespace fpi::fluid
