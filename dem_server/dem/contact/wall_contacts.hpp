/// Which bodies are near which facets of walls, with the histories of their contacts: apart from the bodies'
/// pairs, since walls have a geometry and motions of their own. A grain that goes over a joint takes the
/// history of its contact along from facet to facet.
#pragma once

#include <algorithm>

#include "dem/contact/contact.hpp"

namespace fpi::dem {

struct WallPlace {
  std::uint32_t body = 0, facet = 0;
  Image image{};  ///< of the facet that the body, where its path has led it, is near
  auto operator<=>(const WallPlace&) const = default;
};

struct WallContacts : ContactList<WallPlace> {
  WallMotions motions;  ///< of every wall
  double speed = 0;     ///< [m/s] at most of what bodies can touch of the walls
  double moved = 0;     ///< [m] at most since the search

  /// All walls go on for `duration` [s].
  void drift(double duration);
};

/// Lists every free body and facet, or image of it, whose gap is at most `widest_gap` [m]; histories stay
/// with their places.
void search_walls(const Model& model, const std::vector<Vec3>& position, double widest_gap,
                  WallContacts& contacts);

/// The largest speed [m/s] of the walls' motions, at bodies where a wall has no end.
double largest_speed(const Walls& walls, const WallMotions& motions, const std::vector<Vec3>& position);

/// A body and the facet near it, as they are now.
Near near(const Model& model, const WallMotions& motions, std::uint32_t body, const NearFacet& facet);
Near near(const Model& model, const std::vector<Vec3>& position, const WallMotions& motions,
          const WallPlace& place);

/// Calls visit(first, last) for the range of places of each body.
template <class Visit>
void each_body_at_walls(const WallContacts& contacts, Visit visit) {
  for (std::size_t first = 0, last = 0; first < contacts.places.size(); first = last) {
    while (last < contacts.places.size() && contacts.places[last].body == contacts.places[first].body) ++last;
    visit(first, last);
  }
}

/// Of the places [first, last) of one body those with a gap of at most `reach` [m] that it can touch by
/// themselves (see keep_own_places).
std::vector<NearFacet> own_places(const Model& model, const std::vector<Vec3>& position,
                                  const WallContacts& contacts, std::size_t first, std::size_t last,
                                  double reach);

/// Calls visit(near) for all of these.
template <class Visit>
void each_own_place(const Model& model, const std::vector<Vec3>& position, const WallContacts& contacts,
                    double reach, Visit visit) {
  each_body_at_walls(contacts, [&](std::size_t first, std::size_t last) {
    for (const NearFacet& facet : own_places(model, position, contacts, first, last, reach))
      visit(near(model, contacts.motions, contacts.places[first].body, facet));
  });
}

/// Adds every contact with a wall to `forces`.
void add_wall_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                       const SubStep& sub_step, WallContacts& contacts, Forces& forces, ContactCount& count);

/// "a and wall" for messages.
std::string names(const Model& model, const WallPlace& place);

}  // namespace fpi::dem
