#include "coupling/prescribed_motion.hpp"

#include <fmt/format.h>

#include <array>

namespace fpi::coupling {
namespace {

/// Points and weights of the five-point Gauss–Legendre rule on [0, 1].
struct QuadraturePoint {
  double place, weight;
};
constexpr std::array<QuadraturePoint, 5> quadrature{{{0.04691007703066800, 0.11846344252809454},
                                                     {0.23076534494715845, 0.23931433524968324},
                                                     {0.5, 0.28444444444444444},
                                                     {0.76923465505284155, 0.23931433524968324},
                                                     {0.95308992296933200, 0.11846344252809454}}};

}  // namespace

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
  for (const QuadraturePoint& q : quadrature) {
    const double t = t0 + q.place * (t1 - t0), weight = q.weight * (t1 - t0);
    moved.position += weight * velocity(t);
    turn += weight * spin(t);
  }
  const double angle = turn.norm();
  if (angle == 0) return moved;
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(angle, turn / angle));
  moved.orientation = (turned * motion.orientation).normalized();
  return moved;
}

}  // namespace fpi::coupling
