#include "fluid/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fluid/element.hpp"
#include "fluid/quadrature.hpp"

namespace fpi::fluid {
namespace {

/// The corner of a boundary edge's triangle that is not on the edge.
Index opposite_vertex(const Mesh& mesh, const BoundaryEdge& b) {
  const auto& [start, end] = mesh.edges[b.edge];
  for (Index v : mesh.cells[b.cell])
    if (v != start && v != end) return v;
  return -1;
}

}  // namespace

Boundary::Boundary(const Mesh& mesh, const std::map<std::string, scene::Boundary>& conditions)
    : mesh_(mesh), constraint_(mesh.n_nodes(), Constraint::none), normal_(mesh.n_nodes(), Vec2::Zero()) {
  const auto& names = mesh.boundary_names;
  for (const auto& [name, condition] : conditions)
    require(std::find(names.begin(), names.end(), name) != names.end(),
            "[fluid.boundaries.{}]: the mesh has no boundary of this name; it has {}: rename it{}", name,
            fmt::join(names, ", "),
            did_you_mean(name, names).empty() ? "" : " (did you mean " + did_you_mean(name, names) + "?)");
  for (const std::string& name : names) {
    const auto it = conditions.find(name);
    require(it != conditions.end(),
            "the boundary \"{}\" of the mesh needs a condition: add [fluid.boundaries.{}]", name, name);
    const scene::Boundary& c = it->second;
    const auto kind = std::find(scene::Boundary::types.begin(), scene::Boundary::types.end(), c.type);
    const Type type = static_cast<Type>(kind - scene::Boundary::types.begin());
    const auto& formulas = type == Type::traction ? c.traction : c.velocity;
    parts_.push_back({type, Expression(formulas[0]), Expression(formulas[1]), {}});
  }
  assign_nodes();
  find_slip_normals();
}

void Boundary::assign_nodes() {
  std::vector<Index> part_of(mesh_.n_nodes(), -1);
  for (const BoundaryEdge& b : mesh_.boundary)
    for (Index node : mesh_.edge_nodes(b.edge))
      if (part_of[node] == -1 || parts_[b.boundary].type < parts_[part_of[node]].type)
        part_of[node] = b.boundary;
  for (Index node = 0; node < mesh_.n_nodes(); ++node) {
    if (part_of[node] == -1) continue;
    Part& part = parts_[part_of[node]];
    part.nodes.push_back(node);
    if (part.type == Type::no_slip || part.type == Type::velocity) constraint_[node] = Constraint::both;
  }
}

/// A node where slip sides meet at more than 30 degrees is a corner and cannot move; else it takes the mean
/// normal.
void Boundary::find_slip_normals() {
  for (const BoundaryEdge& b : mesh_.boundary) {
    if (parts_[b.boundary].type != Type::slip) continue;
    const auto nodes = mesh_.edge_nodes(b.edge);
    const Vec2 along = (mesh_.vertices[nodes[1]] - mesh_.vertices[nodes[0]]).normalized();
    const Vec2 normal(along.y(), -along.x());
    for (Index node : nodes) {
      if (constraint_[node] == Constraint::both) continue;
      if (constraint_[node] == Constraint::none) {
        constraint_[node] = Constraint::normal;
        normal_[node] = normal;
      } else if (std::abs(cross(normal_[node], normal)) > 0.5) {
        constraint_[node] = Constraint::both;
      } else {
        const double same_way = std::copysign(1.0, normal_[node].dot(normal));
        normal_[node] = (normal_[node] + same_way * normal).normalized();
      }
    }
  }
}

void Boundary::impose(double t, Vector& u) const {
  for (const Part& part : parts_)
    for (Index node : part.nodes) {
      auto value = u.segment<2>(2 * node);
      if (part.type == Type::velocity) {
        const Vec2 x = mesh_.node_position(node);
        value = Vec2(part.x(x.x(), x.y(), t), part.y(x.x(), x.y(), t));
      } else if (constraint_[node] == Constraint::both) {
        value.setZero();
      } else if (constraint_[node] == Constraint::normal) {
        value -= normal_[node].dot(value) * normal_[node];
      }
    }
}

void Boundary::check_net_flux(double t, const Vector& u) const {
  double net = 0, gross = 0;
  for (const BoundaryEdge& b : mesh_.boundary) {
    if (is_open(b.boundary)) return;
    const auto nodes = mesh_.edge_nodes(b.edge);
    const Vec2 start = mesh_.vertices[nodes[0]], along = mesh_.vertices[nodes[1]] - start;
    const Vec2 inside = mesh_.vertices[opposite_vertex(mesh_, b)] - start;
    const double outward = cross(along, inside) > 0 ? 1 : -1;
    const Vec2 mean =
        (u.segment<2>(2 * nodes[0]) + u.segment<2>(2 * nodes[1]) + 4 * u.segment<2>(2 * nodes[2])) / 6;
    const double flux =
        outward * (mean.x() * along.y() - mean.y() * along.x());  // Simpson's rule is exact for P2
    net += flux;
    gross += std::abs(flux);
  }
  require(std::abs(net) <= 0.01 * gross,
          "where no boundary is open, as much fluid must enter as leaves; at t = {:g} s a net {:g} m²/s {}: "
          "give one "
          "boundary type = \"traction\", or balance the velocities",
          t, std::abs(net), net > 0 ? "leaves" : "enters");
}

void Boundary::add_tractions(double t, Vector& load) const {
  for (const BoundaryEdge& b : mesh_.boundary) {
    const Part& part = parts_[b.boundary];
    if (part.type != Type::traction || (part.x.is_zero() && part.y.is_zero())) continue;
    const auto nodes = mesh_.edge_nodes(b.edge);
    const Vec2 start = mesh_.vertices[nodes[0]], end = mesh_.vertices[nodes[1]];
    const double length = (end - start).norm();
    for (const LinePoint& point : gauss_legendre(4)) {
      const Vec2 x = start + point.s * (end - start);
      const Vec2 traction(part.x(x.x(), x.y(), t), part.y(x.x(), x.y(), t));
      const Padded n = p2_at({1 - point.s, point.s, 0});
      const std::array<double, 3> values{n[0], n[1], n[3]};
      for (int i = 0; i < 3; ++i)
        load.segment<2>(2 * nodes[i]) += point.weight * length * values[i] * traction;
    }
  }
}

}  // namespace fpi::fluid
