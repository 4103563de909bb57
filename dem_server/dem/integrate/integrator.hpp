/// Advances a state in time by velocity Verlet (symplectic, order 2): a constant force gives v + aΔt and
/// x + vΔt + ½aΔt². Films of liquid, which may be stiff, take their half of each half kick
/// implicitly. Flights and sub-steps follow each other as the estimate demands.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "dem/contact/state.hpp"
#include "dem/contact/sub_steps.hpp"
#include "dem/lubrication/shared_inertia.hpp"

namespace fpi::dem {

/// Outcome of a step. Not converged: `reason` names the body; a shorter step may help.
struct Advanced {
  bool converged = true;
  std::string reason;
  std::uint64_t sub_steps = 0;  ///< flights included
  std::uint64_t contacts = 0;   ///< at the end
  double largest_overlap = 0;   ///< [m] met on the way
  std::uint64_t searches = 0;   ///< for neighbours
};

/// Advances `state` by `duration` [s] under `loads`, weight included. Bodies
/// that are not free keep their velocities and spins; `resolved_gaps` as of LubricationForces. What acts
/// between bodies moves them with `inertia`. A pure function of its arguments, bitwise.
Advanced integrate(const Model& model, const Loads& loads, const SharedInertia& inertia,
                   std::span<const double> resolved_gaps, double duration, State& state);

}  // namespace fpi::dem
