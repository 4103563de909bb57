/// Which bodies are near enough to touch: pairs within a skin, found on a grid, valid until a body has moved
/// half the skin.
#pragma once

#include <limits>

#include "dem/contact_list.hpp"
#include "dem/model.hpp"

namespace fpi::dem {

/// Two bodies a < b.
struct Pair {
  std::uint32_t a = 0, b = 0;
  auto operator<=>(const Pair&) const = default;
};

struct Neighbours : ContactList<Pair> {
  std::vector<Vec3> origin;  ///< [m] where the bodies were at the search; empty: a search is due
  double skin = 0;           ///< [m]; infinite where every pair is listed
  double reach = 0;          ///< [m] gap at which pairs begin to act on each other
  double widest_gap() const { return reach + skin; }
};

/// Lists every pair with a free body whose gap is at most the skin beyond the reach; memories stay with their
/// pairs.
void search(const Model& model, const std::vector<Vec3>& position, double reach, Neighbours& neighbours);

/// True where there are so few bodies and facets of walls that every pair is listed once and for all.
bool lists_every_pair(const Model& model);

/// Where two surfaces are: unit normal from a towards the other, and the gap along it [m], negative where
/// they overlap.
struct Separation {
  Vec3 normal;
  double gap;
};
inline Separation separation(const Model& model, const std::vector<Vec3>& position, const Pair& pair) {
  const Vec3 line = position[pair.b] - position[pair.a];
  const double distance = line.norm();
  return {line / distance, distance - model.bodies.radius[pair.a] - model.bodies.radius[pair.b]};
}

inline constexpr std::uint32_t no_body = std::numeric_limits<std::uint32_t>::max();

/// How a wall moves where a body is near it: its own frame, in which it is at rest.
struct WallFrame {
  Vec3 velocity = Vec3::Zero();  ///< at the body's centre [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]
  double acceleration = 0;       ///< at the body's centre [m/s²]
  bool straight = true;          ///< a gap is at least what the way along the normal leaves of it
};

/// Two surfaces near each other, as they are now: of body a and of body b, or of a wall (b = no_body).
struct Near {
  std::uint32_t a, b;
  Separation at;
  const PairLaw& law;
  WallFrame frame{};
  bool wall() const { return b == no_body; }
};
Near near(const Model& model, const std::vector<Vec3>& position, const Pair& pair);

/// "a and b" for messages.
std::string names(const Model& model, const Pair& pair);

}  // namespace fpi::dem
