#include "step/onset.hpp"

namespace fpi {

std::optional<Onset> find_onset(const scene::Scene& scene, const std::vector<coupling::RigidMotion>& motions,
                                double time) {
  if (scene.output.onset == 0) return std::nullopt;
  std::optional<Onset> found;
  double farthest = scene.output.onset;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    if (!body.is_free()) continue;
    const Eigen::Vector3d way = motions[i].position - coupling::initial_motion(body).position;
    const double diameters = way.norm() / (2 * body.radius);
    if (diameters <= farthest) continue;
    farthest = diameters;
    found = {.time = time, .body = i};
  }
  return found;
}

}  // namespace fpi
