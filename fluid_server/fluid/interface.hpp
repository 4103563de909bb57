/// The interface mesh of a body as the fluid sees it: arcs of its circle or edges of its polygon (an edge is
/// an arc too, below), the multipliers they carry, and the velocity that the body has there (conventions:
/// arcs are never split, only their quadrature is).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/outline.hpp"
#include "fluid/types.hpp"

namespace fpi::fluid {

struct Interface {
  Index body = 0;  ///< the caller's number; the fluid only hands it back
  Outline outline;
  std::vector<double> start, end;  ///< of each arc, parameters of the outline, end > start
  RigidVelocity rigid;             ///< also holds the centre that torque is about [m]
  std::vector<Vec2> sampled;  ///< [m/s] at Gauss–Legendre points of each arc; empty: the rigid law holds

  Index n_arcs() const { return static_cast<Index>(start.size()); }
  double length(Index arc) const { return outline.length(start[arc], end[arc]); }  ///< [m]
  /// Velocity of the body at a parameter of an arc [m/s]: the rigid law, or the polynomial through the
  /// samples.
  Vec2 velocity(Index arc, double parameter) const;
  /// The multiplier is a continuous function of the outline, linear along each arc between values at both
  /// ends; numbers of those that an arc has. At a corner, where tractions are singular, it jumps, and the
  /// edges beside it carry one constant value, twice in this list.
  std::array<Index, 2> multipliers(Index arc) const;
  /// Values of their two functions at a parameter of the arc; they add up to 1.
  std::array<double, 2> hats(Index arc, double parameter) const;
  /// Integral of each multiplier's function along the whole outline [m].
  std::vector<double> multiplier_lengths() const;
  /// True where both have the same arcs at the same place; velocities may differ.
  bool same_geometry(const Interface& other) const;
};

/// Sets outline and arcs: edges between vertices that go once around counter-clockwise [m].
void set_edges(Interface& interface, const std::vector<Vec2>& vertices);

/// Throws Error, naming the body, unless the arcs follow one another once around an outline of a sensible
/// size and the samples fit them; no two bodies may be the same or lie on top of each other.
void check(std::span<const Interface> interfaces);

}  // namespace fpi::fluid
