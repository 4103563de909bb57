#include "reported.hpp"

#include <algorithm>

namespace fpi {
namespace {

DragLift drag_lift(const scene::Coefficients& asked, const scene::Scene& scene,
                   const Simulation& simulation) {
  const double unit =
      0.5 * scene.fluid->density * asked.velocity * asked.velocity * asked.length * scene.thickness;
  const auto body = std::ranges::find(scene.bodies, asked.on, &scene::Body::name);
  if (body == scene.bodies.end()) {
    return {.drag = simulation.figure("force_x:" + asked.on) / unit,
            .lift = simulation.figure("force_y:" + asked.on) / unit};
  }
  const auto index = static_cast<std::size_t>(body - scene.bodies.begin());
  const Eigen::Vector3d& force = simulation.state().loads[index].force;
  return {.drag = force.x() / unit, .lift = force.y() / unit};
}

}  // namespace

Reported reported(const scene::Scene& scene, const Simulation& simulation) {
  Reported values;
  for (const scene::Probe& probe : scene.probes) values.probes.push_back(simulation.figure(probe.name));
  if (scene.coefficients && scene.fluid)
    values.coefficients = drag_lift(*scene.coefficients, scene, simulation);
  return values;
}

}  // namespace fpi
