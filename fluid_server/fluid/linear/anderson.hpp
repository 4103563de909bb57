/// Anderson's acceleration of x ← x + δ(x): the combination of the last iterates whose combined correction is
/// shortest (D. G. Anderson, J. ACM 12, 1965). For a linear problem it is GMRES on the corrections.
#pragma once

#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

class Anderson {
 public:
  static constexpr std::size_t depth = 12;

  /// The step from x to the next iterate, for the correction δ(x); x must be where the last step led. Lengths
  /// are measured with `weight`, one entry each (0 leaves an unknown out).
  Vector step(const Vector& correction, const Vector& weight);
  /// Forgets everything: another map, or another place.
  void clear();

 private:
  void remember(const Vector& step, const Vector& change, const Vector& weight);

  std::vector<Vector> steps_, changes_;  // x_{j+1} − x_j, δ_{j+1} − δ_j
  Vector last_step_, last_correction_;
};

}  // namespace fpi::fluid
