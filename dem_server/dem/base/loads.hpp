/// What acts on bodies over a whole step besides contacts: weight and the forces of a fluid, held, or linear
/// in time from the start of the step to its end.
#pragma once

#include <vector>

#include "dem/base/rotation.hpp"

namespace fpi::dem {

struct Forces {
  std::vector<Vec3> force;   ///< [N]
  std::vector<Vec3> torque;  ///< [N m] about the centre

  Forces() = default;
  explicit Forces(std::size_t n) : force(n, Vec3::Zero()), torque(n, Vec3::Zero()) {}
  bool empty() const { return force.empty(); }
  /// Adds `share` of others.
  void add(double share, const Forces& other) {
    for (std::size_t i = 0; i < force.size(); ++i) {
      force[i] += share * other.force[i];
      torque[i] += share * other.torque[i];
    }
  }
};

struct Loads {
  Forces start;
  Forces growth;  ///< from the start of the step to its end; empty: held
  bool held() const { return growth.empty(); }

  /// After a share of the step.
  Forces at(double share) const {
    Forces forces = start;
    if (!held()) forces.add(share, growth);
    return forces;
  }
};

}  // namespace fpi::dem
