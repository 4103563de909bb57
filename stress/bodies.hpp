/// Bodies of many shapes that move together along a smooth start.
#pragma once

#include "march.hpp"
#include "random.hpp"

namespace fpi::fluid::testing {

/// A disc, or a polygon with corners no farther than half a diameter from its centre.
struct Shape {
  double diameter = 1;        ///< [m]
  std::vector<Vec2> corners;  ///< about the centre [m]; none: a disc
};
Shape random_shape(Random& random, double diameter);

/// At rest at t = 0, then ever nearer to `velocity` and `spin`.
struct MovingBody {
  Shape shape;
  Vec2 start = Vec2::Zero();     ///< [m]
  double angle = 0;              ///< at the start [rad]
  Vec2 velocity = Vec2::Zero();  ///< [m/s]
  double spin = 0;               ///< [rad/s]
};

/// Speed over the final one: a smooth rise in a time of `rise` [s], then 1.
struct SmoothStart {
  double rise;
  double speed(double t) const;
  double way(double t) const;  ///< ∫ speed [s]
};

Bodies moving_together(std::vector<MovingBody> bodies, SmoothStart start);

}  // namespace fpi::fluid::testing
