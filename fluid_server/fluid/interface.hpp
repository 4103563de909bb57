/// The interface mesh of a body as the fluid sees it: exact arcs of a circle with one multiplier each, and
/// the velocity that the body has there (conventions: arcs are never split, only their quadrature is).
#pragma once

#include <span>
#include <vector>

#include "fluid/cut.hpp"
#include "fluid/types.hpp"

namespace fpi::fluid {

struct Interface {
  Index body = 0;                  ///< the caller's number; the fluid only hands it back
  double radius = 0;               ///< [m]
  std::vector<double> start, end;  ///< of each arc [rad], counter-clockwise, end > start
  RigidVelocity rigid;             ///< also holds the centre [m]
  std::vector<Vec2> sampled;  ///< [m/s] at Gauss–Legendre points of each arc; empty: the rigid law holds

  Index n_arcs() const { return static_cast<Index>(start.size()); }
  Disc disc() const { return {rigid.centre, radius}; }
  /// Velocity of the body at an angle of an arc [m/s]: the rigid law, or the polynomial through the samples.
  Vec2 velocity(Index arc, double angle) const;
  /// True where both have the same arcs at the same place; velocities may differ.
  bool same_geometry(const Interface& other) const;
};

/// Throws Error, naming the body, unless the arcs follow one another once around a circle of a sensible size
/// and the samples fit them; no two bodies may be the same or lie on top of each other.
void check(std::span<const Interface> interfaces);

}  // namespace fpi::fluid
