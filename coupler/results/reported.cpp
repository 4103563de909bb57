#include "results/reported.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace fpi {
namespace {

double figure_or_nan(const CoupledProblem& problem, const std::string& name) {
  return problem.figure(name).value_or(std::numeric_limits<double>::quiet_NaN());
}

BoundaryLoad boundary_load(const CoupledProblem& problem, const std::string& name) {
  return {.fx = figure_or_nan(problem, "force_x:" + name),
          .fy = figure_or_nan(problem, "force_y:" + name),
          .torque = figure_or_nan(problem, "torque:" + name)};
}

DragLift drag_lift(const scene::Coefficients& asked, const scene::Scene& scene,
                   const CoupledProblem& problem) {
  const double unit =
      0.5 * scene.fluid->density * asked.velocity * asked.velocity * asked.length * scene.thickness;
  const auto body = std::ranges::find(scene.bodies, asked.on, &scene::Body::name);
  if (body == scene.bodies.end()) {
    const BoundaryLoad load = boundary_load(problem, asked.on);
    require(std::isfinite(load.fx) && std::isfinite(load.fy),
            "the fluid must report \"force_x:{}\" and \"force_y:{}\" with every accepted step; it did not: "
            "remove the coefficients of \"{}\" from the scene, or use a fluid that offers them",
            asked.on, asked.on, asked.on);
    return {.drag = load.fx / unit, .lift = load.fy / unit};
  }
  const auto index = static_cast<std::size_t>(body - scene.bodies.begin());
  const Eigen::Vector3d& force = problem.state().loads[index].force;
  return {.drag = force.x() / unit, .lift = force.y() / unit};
}

}  // namespace

std::vector<std::string> holding_boundaries(const scene::Scene& scene) {
  std::vector<std::string> names;
  if (!scene.fluid) return names;
  for (const auto& [name, boundary] : scene.fluid->boundaries)
    if (boundary.holds_fluid()) names.push_back(name);
  return names;
}

std::vector<std::string> found_drives(const scene::Scene& scene) {
  std::vector<std::string> names;
  if (!scene.fluid) return names;
  for (const int axis : {0, 1})
    if (!scene.fluid->superficial_velocity.empty() && !scene.periodic.along(axis).empty())
      names.emplace_back(axis == 0 ? "pressure_drop_x" : "pressure_drop_y");
  for (const auto& [name, boundary] : scene.fluid->boundaries)
    if (boundary.flow_rate) names.push_back("pressure_at_" + name);
  return names;
}

std::string column_of(const scene::Coefficients& coefficients, const std::string& quantity) {
  return coefficients.name.empty() ? quantity : coefficients.name + "." + quantity;
}

Reported reported(const scene::Scene& scene, const CoupledProblem& problem) {
  Reported values;
  for (const scene::Probe& probe : scene.probes) values.probes.push_back(figure_or_nan(problem, probe.name));
  for (const std::string& name : holding_boundaries(scene))
    values.boundaries.push_back(boundary_load(problem, name));
  for (const std::string& name : found_drives(scene)) values.drives.push_back(figure_or_nan(problem, name));
  for (const scene::Coefficients& asked : scene.coefficients)
    values.coefficients.push_back(drag_lift(asked, scene, problem));
  for (std::size_t e = 0; has_energies(scene) && e < scene::Dem::energies.size(); ++e)
    values.energies.push_back(figure_or_nan(problem, scene::energy_column(e)));
  return values;
}

}  // namespace fpi
