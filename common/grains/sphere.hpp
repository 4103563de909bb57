/// A disc or sphere at a place, and the box that grains are put into: what the generators speak of.
#pragma once

#include <cmath>
#include <cstddef>

#include "scene/bodies.hpp"

namespace fpi::grains {

using Vec3 = scene::Vec3;  ///< plane scenes leave z = 0

struct Sphere {
  Vec3 centre{};      ///< [m]
  double radius = 0;  ///< [m]
};

/// Length [m] after which everything repeats itself along each axis; 0: it does not.
using Periods = Vec3;

/// b − a, by the shortest way around where space is periodic [m].
inline Vec3 difference(const Vec3& a, const Vec3& b, const Periods& periods) {
  Vec3 d;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = b[k] - a[k];
    if (periods[k] > 0) d[k] -= periods[k] * std::round(d[k] / periods[k]);
  }
  return d;
}

inline double length(const Vec3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

struct Box {
  Vec3 lower{}, upper{};   ///< [m]
  std::size_t axes = 3;    ///< 2: a rectangle
  Periods periods{};       ///< the box's own side along periodic axes
  double volume() const {  ///< [m³], of a rectangle the area [m²]
    double product = 1;
    for (std::size_t k = 0; k < axes; ++k) product *= upper[k] - lower[k];
    return product;
  }
};

}  // namespace fpi::grains
