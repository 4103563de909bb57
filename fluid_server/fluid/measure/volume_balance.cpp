#include "fluid/measure/volume_balance.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/discretisation/arc_points.hpp"

namespace fpi::fluid {
namespace {

struct SurfaceFlow {
  double body = 0, fluid = 0;  ///< ∫V·n and ∫u·n, n out of the bodies [m²/s]
};

SurfaceFlow through_surfaces(const System& system, const Vector& u) {
  const Space& space = system.space();
  SurfaceFlow flow;
  for (const ArcPiece& piece : system.cut().pieces) {
    const Interface& interface = system.interfaces()[piece.interface];
    const auto nodes = space.mesh.cell_nodes(piece.cell);
    for (const ArcPoint& point : arc_points(space, interface, piece)) {
      const Vec2 n = point.weight * interface.surface.normal(point.parameter);
      flow.body += n.dot(interface.velocity(piece.arc, point.parameter));
      flow.fluid += n.dot(value_at(nodes, point.shape, u));
    }
  }
  return flow;
}

}  // namespace

double VolumeBalance::rest() const {
  double sum = 0;
  for (const Term& term : terms) sum += term.inflow;
  return sum;
}

std::vector<PartInflow> inflow_of_parts(const System& system, const Vector& u) {
  const Space& space = system.space();
  const Components& components = system.components();
  const std::vector<Surface> bodies = surfaces(system.cut().images);
  std::vector<PartInflow> parts(components.n());
  const std::vector<std::uint8_t> open = space.boundary.open_components(components);
  for (Index part = 0; part < components.n(); ++part) {
    parts[part].is_given = open[part] == 0;
    std::vector<Index> sides = components.of_boundary;
    for (Index& side : sides) side = side == part ? part : -1;
    if (std::ranges::all_of(sides, [](Index side) { return side < 0; })) parts[part].is_given = false;
    if (!parts[part].is_given) continue;  // a pore between bodies, too: it is let go
    for (Index b = 0; b < static_cast<Index>(space.mesh.boundary_names.size()); ++b) {
      Vector inward = Vector::Zero(u.size());
      space.boundary.add_pressure(b, {bodies, sides}, inward);
      const double inflow = inward.dot(u);
      parts[part].net += inflow;
    }
  }
  for (const ArcPiece& piece : system.cut().pieces) {
    const Index number = components.of_cell[piece.cell];
    if (number < 0) continue;
    PartInflow& part = parts[number];
    const Interface& interface = system.interfaces()[piece.interface];
    if (!part.is_given) continue;
    for (const ArcPoint& point : arc_points(space, interface, piece)) {
      const double inflow =
          point.weight *
          interface.surface.normal(point.parameter).dot(interface.velocity(piece.arc, point.parameter));
      part.net += inflow;
    }
  }
  return parts;
}

VolumeBalance volume_balance(const System& system, const Vector& u) {
  const Space& space = system.space();
  const std::vector<Surface> bodies = surfaces(system.cut().images);
  VolumeBalance out;
  for (Index b = 0; b < static_cast<Index>(space.mesh.boundary_names.size()); ++b) {
    Vector inward = Vector::Zero(u.size());
    space.boundary.add_pressure(b, {bodies, system.components().of_boundary}, inward);
    out.terms.push_back({"boundary:" + space.mesh.boundary_names[b], inward.dot(u)});
  }
  const SurfaceFlow flow = through_surfaces(system, u);
  out.terms.push_back({"bodies", flow.body});
  out.terms.push_back({"leak", flow.fluid - flow.body});
  return out;
}

}  // namespace fpi::fluid
