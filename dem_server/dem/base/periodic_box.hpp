/// A box in which everything repeats itself along some axes. Positions go on beyond it, so that paths have no
/// jumps; the difference of two is taken the shortest way around.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/lanes.hpp"

namespace fpi::dem {

/// Which of the images of something in a periodic box: by how many boxes it is moved along each axis.
using Image = std::array<std::int64_t, 3>;

struct PeriodicBox {
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();   ///< [m]
  Eigen::Vector3d length = Eigen::Vector3d::Zero();  ///< [m]; 0: does not repeat itself along this axis

  bool repeats() const { return !length.isZero(0); }

  /// One entry of a difference of positions, the shortest way around [m].
  template <class Real>
  Real shortest(Real difference, int axis) const {
    const double period = length[axis];
    return period > 0 ? Real(difference - period * round(difference * (1 / period))) : difference;
  }
  Eigen::Vector3d shortest(const Eigen::Vector3d& line) const {
    return {shortest(line.x(), 0), shortest(line.y(), 1), shortest(line.z(), 2)};
  }
  /// How far an image is from what it is an image of [m].
  Eigen::Vector3d shift(const Image& image) const {
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
      if (image[axis] != 0) moved[axis] = static_cast<double>(image[axis]) * length[axis];
    return moved;
  }
  /// The place in the box that x stands for.
  Eigen::Vector3d inside(Eigen::Vector3d x) const {
    for (int axis = 0; axis < 3; ++axis)
      if (length[axis] > 0) x[axis] -= length[axis] * std::floor((x[axis] - lower[axis]) / length[axis]);
    return x;
  }
};

}  // namespace fpi::dem
