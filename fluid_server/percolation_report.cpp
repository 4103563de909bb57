#include "percolation_report.hpp"

#include <cmath>
#include <numbers>
#include <tuple>

namespace fpi::fluid {
namespace {

int axis_of(const scene::Percolation& asked) { return asked.direction == "x" ? 0 : 1; }

/// Permeability after Kozeny and Carman, n³/(5 S²), with the wetted surface S of the whole volume [m²].
double kozeny_carman(const PoreFlow& flow) {
  constexpr double kozeny = 5;
  return std::pow(flow.porosity(), 3) / (kozeny * flow.specific_surface() * flow.specific_surface());
}

proto::Sheet sections_table(const scene::Percolation& asked, const NavierStokes& solver) {
  proto::Sheet table{.name = "sections",
                     .columns = {asked.direction, "porosity", "pressure", "superficial_velocity"}};
  for (const Section& s : solver.sections(axis_of(asked), static_cast<int>(asked.sections)))
    table.values.insert(table.values.end(), {s.place, s.porosity, s.pressure, s.velocity});
  return table;
}

proto::Sheet velocities_table(const scene::Percolation& asked, const NavierStokes& solver) {
  proto::Sheet table{.name = "velocities", .columns = {"from", "to", "share"}};
  for (const SpeedBin& bin : solver.speed_histogram(axis_of(asked), static_cast<int>(asked.bins)))
    table.values.insert(table.values.end(), {bin.from, bin.to, bin.share});
  return table;
}

/// `radius` is that of the disc of equal area, as the fluid sees it.
proto::Sheet grains_table(const scene::Scene& scene, const NavierStokes& solver) {
  proto::Sheet table{.name = "grains", .columns = {"body", "x", "y", "radius", "drag", "lift", "torque"}};
  const int axis = axis_of(*scene.percolation);
  for (const BodyTraction& grain : solver.body_tractions()) {
    const scene::Body& body = scene.bodies[static_cast<std::size_t>(grain.body)];
    const double area = body.volume(scene.hydraulic_radius_ratio * body.radius, 1);
    const Vec2 force = scene.thickness * grain.force;
    table.values.insert(table.values.end(),
                        {static_cast<double>(grain.body), grain.motion.centre.x(), grain.motion.centre.y(),
                         std::sqrt(area / std::numbers::pi), force[axis], axis == 0 ? force.y() : -force.x(),
                         scene.thickness * grain.torque});
  }
  return table;
}

}  // namespace

proto::Figures percolation_figures(const scene::Scene& scene, NavierStokes& solver) {
  if (!scene.percolation) return {};
  const int axis = axis_of(*scene.percolation);
  const PoreFlow flow = solver.pore_flow();
  proto::Figures figures;
  const auto add = [&figures](const std::string& name, double value) {
    if (std::isfinite(value)) figures.emplace_back("percolation:" + name, value);
  };
  add("porosity", flow.porosity());
  add("superficial_velocity_x", flow.superficial_velocity().x());
  add("superficial_velocity_y", flow.superficial_velocity().y());
  add("pore_velocity", flow.pore_velocity()[axis]);
  add("largest_speed", flow.largest_speed);
  add("tortuosity", flow.tortuosity(axis));
  add("specific_surface", flow.specific_surface());
  const double velocity = flow.superficial_velocity()[axis];
  if (const auto fall = solver.pressure_fall(axis)) {
    const double permeability = scene.fluid->viscosity() * velocity / *fall;
    add("pressure_gradient", -*fall);
    add("permeability", permeability);
    add("kozeny_constant", 5 * kozeny_carman(flow) / permeability);
  }
  add("kozeny_carman_permeability", kozeny_carman(flow));
  return figures;
}

proto::Figures permeability_figures(const scene::Scene& scene, NavierStokes& solver) {
  proto::Figures figures;
  if (!scene.percolation || !scene.time.steady) return figures;
  const Eigen::Matrix2d k = solver.permeability();
  for (const auto& [name, i, j] : {std::tuple{"permeability_xx", 0, 0},
                                   {"permeability_xy", 0, 1},
                                   {"permeability_yx", 1, 0},
                                   {"permeability_yy", 1, 1}})
    if (k(i, i) != 0 && k(j, j) != 0) figures.emplace_back(std::string("percolation:") + name, k(i, j));
  return figures;
}

std::vector<proto::Sheet> percolation_tables(const scene::Scene& scene, const NavierStokes& solver) {
  if (!scene.percolation) return {};
  return {sections_table(*scene.percolation, solver), velocities_table(*scene.percolation, solver),
          grains_table(scene, solver)};
}

}  // namespace fpi::fluid
