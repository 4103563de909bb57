/// The motion of a body that does not react, or of a wall: by formulas of t, or held.
#pragma once

#include <string>
#include <vector>

#include "core/expression.hpp"
#include "coupling/rigid_motion.hpp"
#include "scene/walls.hpp"

namespace fpi::coupling {

class PrescribedMotion {
 public:
  /// Of a body with motion = "prescribed" or "fixed".
  explicit PrescribedMotion(const scene::Body& body);
  explicit PrescribedMotion(const scene::Wall& wall);

  /// `motion` with the velocities of time t [s]; the position stays.
  RigidMotion with_velocities(RigidMotion motion, double t) const;

  /// The motion at t1, from that at t0: position and turn by the integrals of the formulas, jumps included,
  /// whatever the step (quadrature.hpp). The turn is exact where its axis stays.
  RigidMotion advanced(const RigidMotion& motion, double t0, double t1) const;

 private:
  /// Takes up formulas along the axes, which stand at `key` in the scene; those left out are zero.
  void move_by(const std::vector<std::string>& along, const std::string& key);
  Eigen::Vector3d velocity(double t) const;
  Eigen::Vector3d spin(double t) const;

  /// Velocities along the axes, then spins; none of a body that is held, as there may be many.
  std::vector<Expression> formulas_;
};

}  // namespace fpi::coupling
