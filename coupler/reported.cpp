#include "reported.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace fpi {
namespace {

double boundary_force(const Simulation& simulation, const std::string& name) {
  const std::optional<double> force = simulation.figure(name);
  require(force.has_value(),
          "the fluid must report \"{}\" with every accepted step; it did not: remove [coefficients] from the "
          "scene, or "
          "use a fluid that offers it",
          name);
  return *force;
}

DragLift drag_lift(const scene::Coefficients& asked, const scene::Scene& scene,
                   const Simulation& simulation) {
  const double unit =
      0.5 * scene.fluid->density * asked.velocity * asked.velocity * asked.length * scene.thickness;
  const auto body = std::ranges::find(scene.bodies, asked.on, &scene::Body::name);
  if (body == scene.bodies.end()) {
    return {.drag = boundary_force(simulation, "force_x:" + asked.on) / unit,
            .lift = boundary_force(simulation, "force_y:" + asked.on) / unit};
  }
  const auto index = static_cast<std::size_t>(body - scene.bodies.begin());
  const Eigen::Vector3d& force = simulation.state().loads[index].force;
  return {.drag = force.x() / unit, .lift = force.y() / unit};
}

}  // namespace

Reported reported(const scene::Scene& scene, const Simulation& simulation) {
  Reported values;
  for (const scene::Probe& probe : scene.probes)
    values.probes.push_back(simulation.figure(probe.name).value_or(std::numeric_limits<double>::quiet_NaN()));
  if (scene.coefficients && scene.fluid)
    values.coefficients = drag_lift(*scene.coefficients, scene, simulation);
  return values;
}

}  // namespace fpi
