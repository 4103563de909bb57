#include "dem/contact/pair_histories.hpp"

#include <algorithm>
#include <optional>

namespace fpi::dem {
namespace {

/// A rolling spring holds what the lower particle did over the higher one; in the scene a < b may be the
/// other way round.
double direction(bool swapped) { return swapped ? -1 : 1; }

/// The pair that a particle lists with another one.
std::optional<std::size_t> pair_of(const Neighbours& neighbours, std::uint32_t i, std::uint32_t other) {
  const auto first = neighbours.other.begin() + neighbours.start[i];
  const auto last = neighbours.other.begin() + neighbours.start[i + 1];
  const auto found = std::lower_bound(first, last, other);
  if (found == last || *found != other) return std::nullopt;
  return static_cast<std::size_t>(found - neighbours.other.begin());
}

}  // namespace

PairHistories::PairHistories(const ContactList<Pair>& contacts, const Neighbours& neighbours, bool turning)
    : slip(neighbours.n_pairs()),
      roll(turning ? neighbours.n_pairs() : 0),
      touching(neighbours.n_pairs() + n_lanes, 0) {
  std::vector<std::uint32_t> particle(neighbours.size());
  for (std::uint32_t k = 0; k < particle.size(); ++k) particle[neighbours.order[k]] = k;
  for (std::size_t c = 0; c < contacts.places.size(); ++c) {
    const auto [a, b] = contacts.places[c];
    std::uint32_t lower = particle[a];
    auto found = pair_of(neighbours, lower, particle[b]);
    if (!found) found = pair_of(neighbours, lower = particle[b], particle[a]);
    if (!found) continue;
    const std::size_t p = *found;
    const ContactHistory& history = contacts.histories[c];
    touching[p] = 1;
    slip[p] = join(history.slip, history.twist);
    if (turning) roll[p] = join(direction(lower != particle[a]) * history.roll, 0);
  }
}

ContactList<Pair> PairHistories::collect(const Neighbours& neighbours) const {
  ContactList<Pair> contacts;
  const auto n = static_cast<std::size_t>(
      std::count(touching.begin(), touching.begin() + static_cast<std::ptrdiff_t>(neighbours.n_pairs()), 1));
  contacts.places.reserve(n);
  contacts.histories.reserve(n);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    for (std::uint32_t p = neighbours.start[i]; p < neighbours.start[i + 1]; ++p) {
      if (!touching[p]) continue;
      const std::uint32_t low = neighbours.order[i], high = neighbours.order[neighbours.other[p]];
      contacts.places.push_back({std::min(low, high), std::max(low, high)});
      contacts.histories.push_back({.slip = slip[p].head<3>(), .twist = slip[p][3]});
      if (!roll.empty()) contacts.histories.back().roll = direction(low > high) * roll[p].head<3>();
    }
  }
  return contacts;
}

}  // namespace fpi::dem
