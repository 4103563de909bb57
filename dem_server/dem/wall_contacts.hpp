/// Which bodies are near which walls, with the memories of their contacts: apart from the bodies' pairs,
/// since walls are few and their geometry is their own.
#pragma once

#include "dem/neighbours.hpp"

namespace fpi::dem {

struct WallPlace {
  std::uint32_t body = 0, wall = 0;
  auto operator<=>(const WallPlace&) const = default;
};

using WallContacts = ContactList<WallPlace>;

/// Lists every free body and wall whose gap is at most `widest_gap` [m]; memories stay with their places.
void search_walls(const Model& model, const std::vector<Vec3>& position, double widest_gap,
                  WallContacts& contacts);

Near near(const Model& model, const std::vector<Vec3>& position, const WallPlace& place);

/// "a and wall" for messages.
std::string names(const Model& model, const WallPlace& place);

}  // namespace fpi::dem
