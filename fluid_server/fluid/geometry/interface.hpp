/// The interface mesh of a body as the fluid sees it: arcs of its circle or edges of its polygon (an edge is
/// an arc too, below), and the velocity that the body has there (conventions: arcs are never split, only
/// their quadrature is). Which multipliers they carry is said by MultiplierNodes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fluid/base/types.hpp"
#include "fluid/geometry/surface.hpp"

namespace fpi::fluid {

/// The balance of momentum of a body that the fluid is to move, over a step, per metre of thickness. The
/// fluid adds what it exerts itself.
struct Balance {
  double mass_rate = 0;      ///< m/Δt [kg/(m s)]
  double inertia_rate = 0;   ///< J/Δt [kg m/s]
  Vec2 load = Vec2::Zero();  ///< (m/Δt) V at the start of the step, and forces other than the fluid's [N/m]
  double torque = 0;         ///< (J/Δt) ω at its start, and torques other than the fluid's [N]
};

struct Interface {
  Index body = 0;  ///< the caller's number; the fluid only hands it back
  Surface surface;
  std::vector<double> start, end;  ///< of each arc, parameters of the surface, end > start
  RigidVelocity rigid;             ///< also holds the centre that torque is about [m]
  std::vector<Vec2> sampled;  ///< [m/s] at Gauss–Legendre points of each arc; empty: the rigid law holds
  std::optional<Balance> balance;  ///< where the fluid moves the body; its velocity is a guess then

  Index n_arcs() const { return static_cast<Index>(start.size()); }
  double length(Index arc) const { return surface.length(start[arc], end[arc]); }  ///< [m]
  /// Velocity of the body at a parameter of an arc [m/s]: the rigid law, or the polynomial through the
  /// samples.
  Vec2 velocity(Index arc, double parameter) const;
  /// True where both have the same arcs at the same place and are moved alike; velocities may differ.
  bool same_geometry(const Interface& other) const;
};

/// Sets surface and arcs: edges between vertices that go once around counter-clockwise [m].
void set_edges(Interface& interface, const std::vector<Vec2>& vertices);

/// Throws Error, naming the body, unless the arcs follow one another once around a surface of a sensible
/// size and the samples fit them; no two bodies may be the same or lie on top of each other.
void check(std::span<const Interface> interfaces);

}  // namespace fpi::fluid
