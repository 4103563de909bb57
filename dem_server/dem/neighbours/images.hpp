/// Images of particles in a periodic box, for the search of neighbours: others see them beyond its planes.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/base/pair.hpp"
#include "dem/base/periodic_box.hpp"
#include "dem/base/record.hpp"

namespace fpi::dem {

/// Of every two opposite images only one.
struct Images {
  std::vector<std::uint32_t> particle;  ///< that each is an image of
  std::vector<int> along;               ///< −1, 0, 1: where it is along the slabs' axis

  /// Adds those to `places` that are within `reach` [m] of the box.
  Images(const PeriodicBox& box, double reach, int slabs_axis, std::vector<Record>& places);

  /// Of pairs of n particles and their images those that have a particle, named by particles alone. Through
  /// the ring of slabs the last comes before the first.
  void resolve(std::uint32_t n, std::vector<Pair>& pairs) const;
};

}  // namespace fpi::dem
