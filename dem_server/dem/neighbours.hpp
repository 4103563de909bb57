/// Which bodies and walls are near enough to touch: pairs within a skin, found on a grid, valid until a body
/// has moved half the skin. Each pair carries the memory of its contact (springs), through searches, rollback
/// and checkpoints.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/model.hpp"

namespace fpi::dem {

/// Two bodies a < b, or body a and wall b − number of bodies.
struct Pair {
  std::uint32_t a = 0, b = 0;
  auto operator<=>(const Pair&) const = default;
};

/// What a contact remembers; zero while it does not touch.
struct Memory {
  Vec3 slip = Vec3::Zero();  ///< stretch of the tangential spring [m]
  Vec3 roll = Vec3::Zero();  ///< stretch of the rolling spring [rad]
  bool empty() const { return slip.isZero(0) && roll.isZero(0); }
};

struct Neighbours {
  std::vector<Pair> pairs;       ///< in ascending order, so that sums do not depend on when the search was
  std::vector<Memory> memories;  ///< of each pair
  std::vector<Vec3> origin;      ///< [m] where the bodies were at the search; empty: a search is due
  double skin = 0;               ///< [m]; infinite where every pair is listed
  double reach = 0;              ///< [m] gap at which pairs begin to act on each other
};

/// Lists every pair with a free body whose gap is at most the skin beyond the reach; memories stay with their
/// pairs.
void search(const Model& model, const std::vector<Vec3>& position, double reach, Neighbours& neighbours);

/// True where there are so few bodies that every pair is listed once and for all.
bool lists_every_pair(const Bodies& bodies);

/// Keeps only pairs with a memory and makes a search due: what a resumed run starts from.
void forget_search(Neighbours& neighbours);

/// Where a pair's surfaces are: unit normal from a towards b, and the gap along it [m], negative where they
/// overlap.
struct Separation {
  Vec3 normal;
  double gap;
};
inline Separation separation(const Model& model, const std::vector<Vec3>& position, const Pair& pair) {
  const double R = model.bodies.radius[pair.a];
  if (pair.b >= model.bodies.size()) {
    const Plane& wall = model.walls[pair.b - model.bodies.size()];
    return {-wall.normal, wall.normal.dot(position[pair.a]) - wall.offset - R};
  }
  const Vec3 line = position[pair.b] - position[pair.a];
  const double distance = line.norm();
  return {line / distance, distance - R - model.bodies.radius[pair.b]};
}

/// "a and b" for messages.
std::string names(const Model& model, const Pair& pair);

}  // namespace fpi::dem
