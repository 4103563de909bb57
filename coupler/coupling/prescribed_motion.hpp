/// The motion of a body that does not react: by formulas of t, or held.
#pragma once

#include <vector>

#include "core/expression.hpp"
#include "coupling/rigid_motion.hpp"

namespace fpi::coupling {

class PrescribedMotion {
 public:
  /// Of a body with motion = "prescribed" or "fixed".
  explicit PrescribedMotion(const scene::Body& body);

  /// `motion` with the velocities of time t [s]; the position stays.
  RigidMotion with_velocities(RigidMotion motion, double t) const;

  /// The motion at t1, from that at t0. Positions and angle come from Gauss–Legendre quadrature of order 10
  /// on the step: round-off for formulas that change little in a step.
  RigidMotion advanced(const RigidMotion& motion, double t0, double t1) const;

 private:
  Eigen::Vector3d velocity(double t) const;
  double spin(double t) const;

  /// Velocities along the axes, then spin; none of a body that is held, as there may be many.
  std::vector<Expression> formulas_;
};

}  // namespace fpi::coupling
