/// All that changes from step to step, and its form as bytes for checkpoints: little-endian, only this
/// program reads it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/contact/wall_contacts.hpp"

namespace fpi::dem {

/// Work on the bodies since the start of the run [J], by what did it; of the account of energies.
struct Works {
  double conservative = 0;  ///< weight, attractions and the springs along normals
  double damping = 0;       ///< along normals
  double friction = 0;      ///< all that acts along surfaces
  double turning = 0;       ///< all that resists rolling and twisting
  double films = 0;
  double loads = 0;
  double boundaries = 0;  ///< walls that move, and what bodies that are not free are moved or held by
};

/// What bodies and contacts have [J].
struct Energies {
  double kinetic = 0;     ///< of free bodies, by their own mass
  double potential = 0;   ///< of height, and of attractions
  double normal = 0;      ///< stored along the normals of contacts
  double tangential = 0;  ///< in their springs along the surface
  double turning = 0;     ///< in their springs of rolling and twisting
  double elastic() const { return normal + tangential + turning; }
  double all() const { return kinetic + potential + elastic(); }
};

struct State {
  Motions motions;
  ContactList<Pair> contacts;  ///< of the bodies that touch each other
  WallContacts wall_contacts;
  Works works;
  std::vector<std::uint32_t> left;  ///< bodies that are no longer there, in the order in which they left
  Energies taken;                   ///< by them and their contacts, of the account of energies
  Forces loads;  ///< of the fluid at the end of the last step, where they are linear; empty before the first
  std::shared_ptr<const Neighbours> neighbours;  ///< none: a search is due
};

/// Lists what may touch, bodies and walls, where the bodies are now; `reach` [m] as of search.
void find_neighbours(const Model& model, double reach, State& state);

inline constexpr std::array all_energies{&Energies::kinetic, &Energies::potential, &Energies::normal,
                                         &Energies::tangential, &Energies::turning};

/// Drops what bodies that left touched and makes a search due.
void forget_contacts_of_left(const Model& model, State& state);

/// Keeps only contacts with a history and makes a search due: what a resumed run starts from.
void forget_search(State& state);

/// Calls visit(near) for every pair and every facet of a wall that a body is near.
template <class Visit>
void each_near(const Model& model, const State& state, Visit visit) {
  const auto& position = state.motions.position;
  each_pair(*state.neighbours, [&](const Pair& pair) { visit(near(model, position, pair)); });
  for (const WallPlace& place : state.wall_contacts.places)
    visit(near(model, position, state.wall_contacts.motions, place));
}

/// The same, but of walls only the places that a body can touch by themselves, with a gap of at most `reach`
/// [m]: what acts through gaps acts once where facets join.
template <class Visit>
void each_acting(const Model& model, const State& state, double reach, Visit visit) {
  const auto& position = state.motions.position;
  each_pair(*state.neighbours, [&](const Pair& pair) { visit(near(model, position, pair)); });
  each_own_place(model, position, state.wall_contacts, reach, visit);
}

/// A state whose search was forgotten, as bytes.
std::vector<std::uint8_t> to_bytes(const State& state);

/// Bitwise the state that was written; a search is due. Throws Error unless the bytes are a whole state of
/// this model: as many bodies, finite numbers, unit quaternions, pairs that exist, in order.
State from_bytes(std::span<const std::uint8_t> bytes, const Model& model);

}  // namespace fpi::dem
