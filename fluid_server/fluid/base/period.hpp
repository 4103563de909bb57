/// The box in which a flow repeats itself, along x, along y, along both, or not at all. Places may be given
/// any number of periods away.
#pragma once

#include <array>
#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

struct Period {
  Vec2 lower = Vec2::Zero(), upper = Vec2::Zero();  ///< [m]; an axis that is not periodic is not looked at
  std::array<bool, 2> along{};

  bool any() const { return along[0] || along[1]; }
  double length(int axis) const { return upper[axis] - lower[axis]; }  ///< [m]
  /// The place in the box that x stands for [m].
  Vec2 wrapped(Vec2 x) const;
  /// All translations by whole periods that bring something between `low` and `high` into the box or to its
  /// sides [m]; without periods there is one, zero.
  std::vector<Vec2> shifts(const Vec2& low, const Vec2& high) const;
};

}  // namespace fpi::fluid
