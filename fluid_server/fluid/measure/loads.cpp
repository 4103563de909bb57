/// What drives the flow: tractions and force densities, and loads of unknown size.
#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "fluid/discretisation/system.hpp"

namespace fpi::fluid {
namespace {

/// Throws Error where what comes in through a boundary has no way to another open one: no pressure drives it.
void require_way_out(const Space& space, const Components& components, Index inlet) {
  std::vector<std::uint8_t> enters(components.n(), 0), leaves = enters;
  for (std::size_t b = 0; b < space.mesh.boundary.size(); ++b) {
    const Index side = space.mesh.boundary[b].boundary, part = components.of_boundary[b];
    if (part >= 0 && space.boundary.is_open(side)) (side == inlet ? enters : leaves)[part] = 1;
  }
  for (Index part = 0; part < components.n(); ++part)
    if (enters[part] != 0 && leaves[part] != 0) return;
  const std::string& name = space.mesh.boundary_names[inlet];
  fail(
      "the flow_rate of the boundary \"{}\" needs a way to another boundary of type = \"traction\"; there is "
      "none: "
      "open one, or leave a way between the bodies (hydraulic_radius_ratio)",
      name);
}

}  // namespace

void System::set_load(double t, const BodyForce& body_force) {
  drives_.set_time(t);
  const bool changes = space_.boundary.traction_depends_on_time() || body_force.depends_on_time();
  if (std::exchange(has_load_, true) && !changes) return;
  load_.setZero();
  space_.boundary.add_tractions(t, {surfaces(cut_.images), components_.of_boundary}, load_);
  if (!body_force.is_zero()) add_force_density([&](const Vec2& x) { return body_force(x, t); }, load_);
}

void System::add_force_density(const std::function<Vec2(const Vec2&)>& f, Vector& load) const {
  for (std::size_t k = 0; k < active_cells_.size(); ++k) {
    const Index c = active_cells_[k];
    const Quadrature rule = quadrature(k);
    const auto nodes = space_.mesh.cell_nodes(c);
    const auto positions = space_.mesh.cell_places(c);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Padded& n = rule.points[q].shape.n;
      const Vec2 force = rule.weight(q) * f(position_at(positions, n));
      for (int i = 0; i < 6; ++i) load.segment<2>(2 * nodes[i]) += n[i] * force;
    }
  }
}

Drives System::make_drives(const scene::Fluid& parameters) const {
  const Mesh& mesh = space_.mesh;
  const auto unit_load = [&](Drive& drive) {
    drive.load = Vector::Zero(load_.size());
    drive.load_on_bodies = Vector::Zero(3 * static_cast<Eigen::Index>(interfaces_.size()));
  };
  std::vector<Drive> drives;
  for (const int axis : {0, 1}) {
    if (parameters.superficial_velocity.empty() || !mesh.period.along[axis]) continue;
    Drive& drive = drives.emplace_back();
    drive.name = axis == 0 ? "pressure_drop_x" : "pressure_drop_y";
    drive.axis = axis;
    drive.given =
        Expression(parameters.superficial_velocity[axis], fmt::format("fluid.superficial_velocity.{}", axis));
    drive.unit = mesh.box().area();
    unit_load(drive);
    const Vec2 along = Vec2::Unit(axis);
    add_force_density([&](const Vec2&) { return along; }, drive.load);
    for (std::size_t i = 0; i < interfaces_.size(); ++i) {
      const Interface& interface = interfaces_[i];
      const Vec2 force = interface.surface.area() * along;
      drive.load_on_bodies.segment<3>(3 * static_cast<Eigen::Index>(i)) << force,
          cross(interface.surface.centroid() - interface.rigid.centre, force);
    }
  }
  for (const auto& [name, boundary] : parameters.boundaries) {
    if (!boundary.flow_rate) continue;
    Drive& drive = drives.emplace_back();
    drive.name = "pressure_at_" + name;
    drive.boundary = name;
    drive.given = Expression(*boundary.flow_rate, fmt::format("fluid.boundaries.{}.flow_rate", name));
    unit_load(drive);
    const auto found = std::ranges::find(mesh.boundary_names, name);
    const auto part = static_cast<Index>(found - mesh.boundary_names.begin());
    require_way_out(space_, components_, part);
    space_.boundary.add_pressure(part, {surfaces(cut_.images), components_.of_boundary}, drive.load);
  }
  return Drives(std::move(drives));
}

}  // namespace fpi::fluid
