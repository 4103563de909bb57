#include "coupling/rigid_motion.hpp"

namespace fpi::coupling {

RigidMotion initial_motion(const scene::Body& body) {
  RigidMotion motion;
  motion.position = to_eigen(scene::to_vec3(body.position));
  if (!body.is_free()) return motion;
  motion.velocity = to_eigen(scene::to_vec3(body.velocity));
  motion.spin = to_eigen(scene::spin_to_vec3(body.spin));
  return motion;
}

}  // namespace fpi::coupling
