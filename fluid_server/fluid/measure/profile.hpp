/// A quantity along a segment: sampled where the segment enters and leaves each cell and half way between, so
/// that what the element can show (a parabola a straight cell) is all there, its extrema included.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fluid/mesh/locator.hpp"

namespace fpi::fluid {

struct ProfilePoint {
  Vec2 place;    ///< [m]
  double value;  ///< of the quantity
};

struct Profile {
  std::vector<ProfilePoint> points;  ///< along the segment, without those that have no value
  ProfilePoint smallest, largest;    ///< of the parabola through the samples of each cell
};

/// The value at a place; nothing inside a body or outside the mesh.
using Sampler = std::function<std::optional<double>(const Vec2&)>;

/// Nothing where no point of the segment has a value.
std::optional<Profile> measure_profile(const Mesh& mesh, const Locator& locator, const Vec2& from,
                                       const Vec2& to, const Sampler& value);

}  // namespace fpi::fluid
