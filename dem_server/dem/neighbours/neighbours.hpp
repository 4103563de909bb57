/// Which bodies are near enough to touch: pairs within a skin, valid until a body has moved half the skin.
/// Bodies are sorted by the cells that they are in, and every pair is listed once, by its lower body.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "dem/base/pair.hpp"
#include "dem/model/model.hpp"
#include "dem/neighbours/contact_list.hpp"

namespace fpi::dem {

/// What a search found; it does not change until the next. Its particles are the bodies in their new order.
struct Neighbours {
  std::vector<std::uint32_t> order;  ///< body of each particle
  std::vector<std::uint32_t> start;  ///< of each particle's pairs in `other`, and their end
  std::vector<std::uint32_t> other;  ///< higher particle of each pair, or one that a particle of the last
                                     ///< slab is near through a periodic plane; padded by the lanes
  std::vector<std::uint32_t> slabs;  ///< first particle of each slab, and the end: no pair reaches beyond the
                                     ///< next slab, which is the first after the last
  std::vector<Vec3> origin;          ///< [m] where each particle was
  double skin = 0;              ///< [m]; infinite where every pair is listed and there is one way between
  double reach = 0;             ///< [m] gap at which pairs begin to act on each other
  std::uint64_t distances = 0;  ///< that were looked at

  double widest_gap() const { return reach + skin; }
  std::size_t size() const { return order.size(); }
  std::size_t n_pairs() const { return start.back(); }
};

/// Lists every pair with a free body whose gap is at most the skin beyond the reach [m].
Neighbours search(const Model& model, const std::vector<Vec3>& position, double reach);

/// True where there are so few bodies and facets of walls that every pair is listed.
bool lists_every_pair(const Model& model);

/// Where two surfaces are: unit normal from a towards the other, and the gap along it [m], negative where
/// they overlap.
struct Separation {
  Vec3 normal;
  double gap;
};
inline Separation separation(const Model& model, const std::vector<Vec3>& position, const Pair& pair) {
  const Vec3 line = model.periodic.shortest(position[pair.b] - position[pair.a]);
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

/// Calls visit(pair) for every pair of a list.
template <class Visit>
void each_pair(const Neighbours& neighbours, Visit visit) {
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    for (std::uint32_t p = neighbours.start[i]; p < neighbours.start[i + 1]; ++p) {
      const std::uint32_t a = neighbours.order[i], b = neighbours.order[neighbours.other[p]];
      visit(Pair{std::min(a, b), std::max(a, b)});
    }
  }
}

/// "a and b" for messages.
std::string names(const Model& model, const Pair& pair);

}  // namespace fpi::dem
