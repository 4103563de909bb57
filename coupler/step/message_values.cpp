#include "step/message_values.hpp"

namespace fpi {

proto::Motion to_wire(std::uint32_t body, const coupling::RigidMotion& motion) {
  const Eigen::Quaterniond& q = motion.orientation;
  return {.body = body,
          .position = to_wire(motion.position),
          .orientation = {q.w(), q.x(), q.y(), q.z()},
          .velocity = to_wire(motion.velocity),
          .spin = to_wire(motion.spin)};
}

coupling::RigidMotion from_wire(const proto::Motion& motion) {
  const auto& [w, x, y, z] = motion.orientation;
  return {.position = coupling::to_eigen(motion.position),
          .orientation = Eigen::Quaterniond(w, x, y, z),
          .velocity = coupling::to_eigen(motion.velocity),
          .spin = coupling::to_eigen(motion.spin)};
}

proto::Interface to_wire(std::uint32_t body, const coupling::Arcs& arcs,
                         const coupling::RigidMotion& motion) {
  proto::Interface interface;
  interface.body = body;
  interface.centre = to_wire(arcs.centre);
  interface.radius = arcs.radius;
  interface.start = arcs.start;
  interface.end = arcs.end;
  interface.vertices = arcs.vertices;
  interface.translation = to_wire(motion.velocity);
  interface.spin = to_wire(motion.spin);
  interface.points = coupling::points_per_arc;
  interface.velocities = coupling::velocities_on(arcs, motion);
  return interface;
}

proto::Load to_wire(std::uint32_t body, const coupling::RigidLoad& load) {
  proto::Load message;
  message.body = body;
  message.force = to_wire(load.force);
  message.torque = to_wire(load.torque);
  return message;
}

proto::Load to_wire(const coupling::Arcs& arcs, const proto::Traction& traction) {
  return {.body = traction.body,
          .force = traction.mean_force.value_or(traction.force),
          .torque = traction.mean_torque.value_or(traction.torque),
          .start = arcs.start,
          .end = arcs.end,
          .tractions = traction.values};
}

}  // namespace fpi
