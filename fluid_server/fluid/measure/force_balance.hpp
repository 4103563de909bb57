/// The balance of momentum of all the fluid: what boundaries, bodies and force densities exert on it makes up
/// for what flows out with it and for its acceleration. Every term is the residual of the discrete equations
/// for a uniform test velocity, so that what is left is the error of the solution, not of an integration.
#pragma once

#include <string>
#include <vector>

#include "fluid/discretisation/system.hpp"
#include "fluid/measure/boundary_traction.hpp"

namespace fpi::fluid {

struct ForceBalance {
  struct Term {
    std::string name;
    Vec2 force = Vec2::Zero();  ///< on the fluid [N/m]
  };
  /// "boundary:NAME" of each, "bodies", "body_force" (with the fall of the mean pressure), "momentum" (minus
  /// what flows out and minus the rate of change).
  std::vector<Term> terms;

  Vec2 rest() const;  ///< what they add up to [N/m]
  /// The rest over the largest term; 0 where all are zero.
  double relative() const;
};

/// Of the flow `fields`, in which the fluid exerts `held` on the boundaries that hold it (in the order of
/// `curves`), at time t [s]. Bodies count with what the mean pressure does to them, the force density
/// `mean_force` [N/m³].
ForceBalance force_balance(System& system, const Flow& flow, const Fields& fields, const TimeTerms& time,
                           double t, const Vec2& mean_force, const std::vector<BoundaryCurve>& curves,
                           const std::vector<BoundaryTraction>& held);

}  // namespace fpi::fluid
