/// [periodic]: the box in which everything repeats itself; the fluid and the grains read it.
#pragma once

#include <cmath>
#include <vector>

#include "core/parameters.hpp"

namespace fpi::scene {

struct Periodic {
  std::vector<double> x, y, z;  ///< the two planes across each axis [m]; empty: not periodic

  const std::vector<double>& along(int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  /// The place [m] in the box that a place anywhere, of three coordinates, stands for.
  template <class Place>
  Place inside(Place at) const {
    for (const int axis : {0, 1, 2}) {
      const std::vector<double>& planes = along(axis);
      if (planes.empty()) continue;
      const double length = planes[1] - planes[0];
      at[axis] -= length * std::floor((at[axis] - planes[0]) / length);
    }
    return at;
  }

  void declare(ParameterVisitor& v) {
    v.reals(
        {"x", "m",
         "[lower, upper]: the planes x = lower and x = upper are one, and what leaves through one comes in "
         "through the other; empty: not periodic"},
        x, {0, 2}, any_number());
    v.reals({"y", "m", "the same along y"}, y, {0, 2}, any_number());
    v.reals({"z", "m", "the same along z, of spheres"}, z, {0, 2}, any_number());
    v.require(x.empty() || (x.size() == 2 && x[0] < x[1]), "x",
              "must be [lower, upper], ascending, or empty");
    v.require(y.empty() || (y.size() == 2 && y[0] < y[1]), "y",
              "must be [lower, upper], ascending, or empty");
    v.require(z.empty() || (z.size() == 2 && z[0] < z[1]), "z",
              "must be [lower, upper], ascending, or empty");
  }
};

}  // namespace fpi::scene
