/// The right-hand side of paper eqs. (21)–(23): loads held over the step, and the forces and moments of the
/// contacts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem/neighbours.hpp"

namespace fpi::dem {

struct Forces {
  std::vector<Vec3> force;   ///< [N]
  std::vector<Vec3> torque;  ///< [N m] about the centre
};

/// What an evaluation of the contacts met.
struct ContactCount {
  std::uint64_t touching = 0;
  double largest_overlap = 0;  ///< [m]
  std::optional<Pair>
      too_deep;  ///< overlaps beyond a radius: the step was too long, or the body came from outside
};

/// Velocities that the contacts see: at the middle of the last sub-step for what their springs have stretched
/// by, and extrapolated to now for what their dashpots feel.
struct Velocities {
  const std::vector<Vec3>& middle;       ///< [m/s]
  const std::vector<Vec3>& middle_spin;  ///< [rad/s]
  const std::vector<Vec3>& now;
  const std::vector<Vec3>& now_spin;
};

/// Adds every contact to `forces`. Springs stretch by `stretch_time` [s] at the middle velocities; `sub_step`
/// [s] is what the normal damping is averaged over.
ContactCount add_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                          double stretch_time, double sub_step, Neighbours& neighbours, Forces& forces);

/// Effective mass m* and radius R* of a pair, with its overlap and the rate at which it grows with
/// `velocity`.
Normal normal_state(const Model& model, const Pair& pair, const Separation& gap,
                    const std::vector<Vec3>& velocity);
const PairLaw& law_of(const Model& model, const Pair& pair);

}  // namespace fpi::dem
