#include "coupling/prescribed_motion.hpp"

#include <string>

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

std::string component(const scene::Body& body, std::size_t i) {
  return i < body.prescribed_velocity.size() ? body.prescribed_velocity[i] : "0";
}

}  // namespace

PrescribedMotion::PrescribedMotion(const scene::Body& body)
    : velocity_{Expression(component(body, 0)), Expression(component(body, 1)),
                Expression(component(body, 2))},
      spin_(body.motion == "prescribed" ? body.prescribed_spin : "0") {}

Eigen::Vector3d PrescribedMotion::velocity(double t) const {
  return {velocity_[0](0, 0, t), velocity_[1](0, 0, t), velocity_[2](0, 0, t)};
}

RigidMotion PrescribedMotion::with_velocities(RigidMotion motion, double t) const {
  motion.velocity = velocity(t);
  motion.spin = {0, 0, spin_(0, 0, t)};
  return motion;
}

RigidMotion PrescribedMotion::advanced(const RigidMotion& motion, double t0, double t1) const {
  RigidMotion moved = with_velocities(motion, t1);
  double angle = 0;
  for (const QuadraturePoint& q : quadrature) {
    const double t = t0 + q.place * (t1 - t0), weight = q.weight * (t1 - t0);
    moved.position += weight * velocity(t);
    angle += weight * spin_(0, 0, t);
  }
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  moved.orientation = (turn * motion.orientation).normalized();
  return moved;
}

}  // namespace fpi::coupling
