/// The contacts' part of the right-hand side of paper eqs. (21)–(23).
#pragma once

#include "dem/contact.hpp"
#include "dem/wall_contacts.hpp"

namespace fpi::dem {

/// Adds every contact to `forces`. Springs stretch by `stretch_time` [s] at the middle velocities; `duration`
/// [s] of the sub-step is what the normal damping is averaged over.
ContactCount add_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                          double stretch_time, double duration, Neighbours& neighbours,
                          WallContacts& wall_contacts, Forces& forces);

}  // namespace fpi::dem
