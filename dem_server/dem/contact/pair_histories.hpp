/// The histories of the contacts between bodies while sub-steps run: one for each listed pair, in the list's
/// order. Between steps only those of touching pairs are kept, by the bodies' numbers in the scene.
#pragma once

#include "dem/contact/particles.hpp"

namespace fpi::dem {

struct PairHistories {
  std::vector<Record> slip;            ///< ContactHistory::slip [m], and stretch of the twisting spring [rad]
  std::vector<Record> roll;            ///< of the rolling spring [rad]; empty where nothing turns against it
  std::vector<std::uint8_t> touching;  ///< 1 or 0; springs of other pairs mean nothing. Padded by the lanes

  /// `contacts` of pairs that are not listed are forgotten.
  PairHistories(const ContactList<Pair>& contacts, const Neighbours& neighbours, bool turning);
  ContactList<Pair> collect(const Neighbours& neighbours) const;
};

}  // namespace fpi::dem
