/// What a sub-step does with each body by itself, in one pass: velocities take what pushes, places and
/// orientations move on.
#pragma once

#include "dem/contact/particles.hpp"

namespace fpi::dem {

struct Sweep {
  double kick = 0;         ///< [s] that velocities take the forces for
  double drift = 0;        ///< [s] that places move for, after the kick
  double extrapolate = 0;  ///< [s] that `now` is ahead of the velocities, by the same forces
  bool clear = false;      ///< whether the forces are used up

  /// Does it to all bodies; `orientation` in the scene's order takes turns that are large. Returns a speed
  /// [m/s] that none of them exceeds.
  double operator()(Particles& particles, std::vector<Orientation>& orientation) const;
};

}  // namespace fpi::dem
