/// [[outlets]]: where grains leave the scene for good.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/parameters.hpp"

namespace fpi::scene {

struct Outlet {
  std::string name;
  std::vector<double> lower, upper;  ///< corners of a box [m]

  void declare(ParameterVisitor& v) {
    v.text({"name", "", "columns are NAME.count, NAME.mass …; unique", true}, name);
    v.reals({"lower", "m", "lowest corner of a box: a free body that is wholly inside at any moment leaves",
             true},
            lower, {2, 3}, any_number());
    v.reals({"upper", "m", "its highest corner", true}, upper, {2, 3}, any_number());
    v.require(std::ranges::equal(lower, upper, std::less()), "upper", "must be above lower along every axis");
  }
};

}  // namespace fpi::scene
