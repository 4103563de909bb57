/// All pairs of spheres that are close to each other, in time that grows as their number does, however much
/// their sizes differ: a grid of cells for every power of two between the smallest and the largest size.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grains/sphere.hpp"

namespace fpi::grains {

using IndexPair = std::array<std::uint32_t, 2>;  ///< first < second

/// The pairs whose surfaces are at most `margin` [m] apart.
std::vector<IndexPair> close_pairs(std::span<const Sphere> spheres, double margin, const Periods& periods);

}  // namespace fpi::grains
