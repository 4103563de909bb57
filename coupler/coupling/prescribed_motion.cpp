#include "coupling/prescribed_motion.hpp"

#include <fmt/format.h>

#include "coupling/quadrature.hpp"

namespace fpi::coupling {

PrescribedMotion::PrescribedMotion(const scene::Body& body) {
  if (body.motion != "prescribed") return;
  move_by(body.prescribed_velocity, fmt::format("bodies.{}.prescribed_velocity", body.name));
  move_by({"0", "0", body.prescribed_spin}, fmt::format("bodies.{}.prescribed_spin", body.name));
}

PrescribedMotion::PrescribedMotion(const scene::Wall& wall) {
  move_by(wall.velocity, fmt::format("walls.{}.velocity", wall.name));
  move_by(wall.spin.size() == 1 ? std::vector<std::string>{"0", "0", wall.spin[0]} : wall.spin,
          fmt::format("walls.{}.spin", wall.name));
}

void PrescribedMotion::move_by(const std::vector<std::string>& along, const std::string& key) {
  for (std::size_t i = 0; i < 3; ++i) formulas_.emplace_back(i < along.size() ? along[i] : "0", key);
}

Eigen::Vector3d PrescribedMotion::velocity(double t) const {
  return {formulas_[0](0, 0, t), formulas_[1](0, 0, t), formulas_[2](0, 0, t)};
}

Eigen::Vector3d PrescribedMotion::spin(double t) const {
  return {formulas_[3](0, 0, t), formulas_[4](0, 0, t), formulas_[5](0, 0, t)};
}

RigidMotion PrescribedMotion::with_velocities(RigidMotion motion, double t) const {
  const bool held = formulas_.empty();
  motion.velocity = held ? Eigen::Vector3d::Zero() : velocity(t);
  motion.spin = held ? Eigen::Vector3d::Zero() : spin(t);
  return motion;
}

RigidMotion PrescribedMotion::advanced(const RigidMotion& motion, double t0, double t1) const {
  RigidMotion moved = with_velocities(motion, t1);
  if (formulas_.empty()) return moved;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    moved.position[axis] += integral(formulas_[i], t0, t1);
    turn[axis] = integral(formulas_[3 + i], t0, t1);
  }
  const double angle = turn.norm();
  if (angle == 0) return moved;
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(angle, turn / angle));
  moved.orientation = (turned * motion.orientation).normalized();
  return moved;
}

}  // namespace fpi::coupling
