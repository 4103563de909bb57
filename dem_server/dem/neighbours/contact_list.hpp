/// Places that may touch, each with the history of its contact (springs), which stays with it through
/// searches, rollback and checkpoints.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "dem/base/rotation.hpp"

namespace fpi::dem {

/// What a contact remembers; zero while it does not touch.
struct ContactHistory {
  Vec3 slip = Vec3::Zero();  ///< n × stretch of the tangential spring [m]: the same seen from either side
  Vec3 roll = Vec3::Zero();  ///< stretch of the rolling spring [rad]
  double twist = 0;          ///< stretch of the spring about the normal [rad]
  bool empty() const { return slip.isZero(0) && roll.isZero(0) && twist == 0; }
};

/// `Place` says who touches whom.
template <class Place>
struct ContactList {
  std::vector<Place> places;              ///< who
  std::vector<ContactHistory> histories;  ///< of each place

  /// Takes up what a search found; histories stay with their places.
  void replace(std::vector<Place> found) {
    std::vector<ContactHistory> carried(found.size());
    std::size_t old = 0;
    for (std::size_t p = 0; p < found.size(); ++p) {
      while (old < places.size() && places[old] < found[p]) ++old;
      if (old < places.size() && places[old] == found[p]) carried[p] = histories[old];
    }
    places = std::move(found);
    histories = std::move(carried);
  }

  void sort() {
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t p) { return places[p]; });
    ContactList sorted;
    for (const std::size_t p : order) {
      sorted.places.push_back(places[p]);
      sorted.histories.push_back(histories[p]);
    }
    *this = std::move(sorted);
  }

  /// Keeps only places with a history: what a resumed run starts from.
  void keep_remembered() {
    keep([](const Place&, const ContactHistory& history) { return !history.empty(); });
  }

  /// Keeps only the places for which wanted(place, history).
  template <class Wanted>
  void keep(Wanted wanted) {
    std::size_t kept = 0;
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (!wanted(places[p], histories[p])) continue;
      places[kept] = places[p];
      histories[kept++] = histories[p];
    }
    places.resize(kept);
    histories.resize(kept);
  }
};

}  // namespace fpi::dem
