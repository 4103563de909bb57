#include "fluid/discretisation/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fluid/base/quadrature.hpp"

namespace fpi::fluid {
namespace {

/// Where the nodes of EdgeNodes are along the edge, and Simpson's weights: exact for P2 values on a parabola,
/// since N_i dx/ds is of degree 3.
constexpr std::array<double, 3> node_s{0, 1, 0.5}, simpson{1.0 / 6, 1.0 / 6, 2.0 / 3};

/// ∫ N_i n ds of the three nodes of an edge, n out of the mesh [m].
std::array<Vec2, 3> outward(const EdgeNodes& edge) {
  std::array<Vec2, 3> out;
  for (int i = 0; i < 3; ++i) {
    const Vec2 along = simpson[i] * edge_tangent(edge, node_s[i]);
    out[i] = {along.y(), -along.x()};
  }
  return out;
}

constexpr double largest_net = 0.01, doubtful_net = 1e-3;  ///< flux, of what goes in and out
/// Of ∫|u|: a wall that moves along itself has no flux but that of round-off and of a parabola beside its
/// circle.
constexpr double along_walls = 1e-4;

}  // namespace

Findings unmatched(const Mesh& mesh, const std::map<std::string, scene::Boundary>& conditions) {
  Findings findings;
  const auto& names = mesh.boundary_names;
  for (const auto& [name, condition] : conditions) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string near = did_you_mean(name, names);
    findings.error("fluid.boundaries." + name,
                   "[fluid.boundaries.{}]: the mesh has no boundary of this name; it has {}: rename it{}",
                   name, fmt::join(names, ", "), near.empty() ? "" : " (did you mean " + near + "?)");
  }
  for (const std::string& name : names)
    if (!conditions.contains(name))
      findings.error("fluid.boundaries",
                     "the boundary \"{}\" of the mesh needs a condition: add [fluid.boundaries.{}]", name,
                     name);
  return findings;
}

Boundary::Boundary(const Mesh& mesh, const std::map<std::string, scene::Boundary>& conditions)
    : mesh_(mesh), constraint_(mesh.n_nodes(), Constraint::none), normal_(mesh.n_nodes(), Vec2::Zero()) {
  unmatched(mesh, conditions).raise();
  for (const std::string& name : mesh.boundary_names) {
    const scene::Boundary& c = conditions.at(name);
    const auto kind = std::find(scene::Boundary::types.begin(), scene::Boundary::types.end(), c.type);
    const Type type = static_cast<Type>(kind - scene::Boundary::types.begin());
    const bool is_traction = type == Type::traction;
    const std::string key =
        fmt::format("fluid.boundaries.{}.{}", name, is_traction ? "traction" : "velocity");
    const auto& formulas = is_traction ? c.traction : c.velocity;
    parts_.push_back({type, Expression(formulas[0], key + ".0"), Expression(formulas[1], key + ".1"), {}});
  }
  assign_nodes();
  find_slip_normals();
}

void Boundary::assign_nodes() {
  std::vector<Index> part_of(mesh_.n_nodes(), -1);
  for (const BoundaryEdge& b : mesh_.boundary)
    for (Index placed : mesh_.edge_nodes(b.edge)) {
      Index& part = part_of[mesh_.owner[placed]];
      if (part == -1 || parts_[b.boundary].type < parts_[part].type) part = b.boundary;
    }
  for (Index node = 0; node < mesh_.n_nodes(); ++node) {
    if (part_of[node] == -1) continue;
    Part& part = parts_[part_of[node]];
    part.nodes.push_back(node);
    if (part.type == Type::no_slip || part.type == Type::velocity) constraint_[node] = Constraint::both;
  }
}

/// The normal of a node is that of ∫ N_i n ds, with which no fluid leaks through the sides as a whole. A node
/// where slip sides meet at more than 30 degrees is a corner and cannot move.
void Boundary::find_slip_normals() {
  const double cos_30 = std::sqrt(0.75);
  for (const BoundaryEdge& b : mesh_.boundary) {
    if (parts_[b.boundary].type != Type::slip) continue;
    const auto nodes = mesh_.edge_nodes(b);
    const auto normals = outward(mesh_.places(nodes));
    for (int i = 0; i < 3; ++i) {
      const Index node = mesh_.owner[nodes[i]];
      Vec2& normal = normal_[node];
      Constraint& constraint = constraint_[node];
      if (constraint == Constraint::both) continue;
      const bool is_corner = constraint == Constraint::normal &&
                             normal.dot(normals[i]) < cos_30 * normal.norm() * normals[i].norm();
      constraint = is_corner ? Constraint::both : Constraint::normal;
      normal += normals[i];
    }
  }
  for (Index node = 0; node < mesh_.n_nodes(); ++node)
    if (constraint_[node] == Constraint::normal) normal_[node].normalize();
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

std::vector<std::uint8_t> Boundary::open_components(const Components& components) const {
  std::vector<std::uint8_t> open(components.n(), 0);
  for (std::size_t b = 0; b < mesh_.boundary.size(); ++b) {
    const Index part = components.of_boundary[b];
    if (part >= 0 && is_open(mesh_.boundary[b].boundary)) open[part] = 1;
  }
  return open;
}

Boundary::Flux Boundary::flux(const Vector& u) const {
  Flux out;
  for (const BoundaryEdge& b : mesh_.boundary) {
    if (is_open(b.boundary)) continue;
    const auto nodes = mesh_.edge_nodes(b);
    const auto normals = outward(mesh_.places(nodes));
    double through = 0;
    for (int i = 0; i < 3; ++i) {
      const auto velocity = u.segment<2>(2 * mesh_.owner[nodes[i]]);
      through += normals[i].dot(velocity);
      out.reach += normals[i].norm() * velocity.norm();
    }
    out.net += through;
    out.gross += std::abs(through);
  }
  return out;
}

bool Boundary::is_closed() const {
  return std::ranges::none_of(mesh_.boundary, [&](const BoundaryEdge& b) { return is_open(b.boundary); });
}

std::string Boundary::doubtful_net_flux(double t, const Vector& u) const {
  if (!is_closed()) return "";
  const auto [net, gross, reach] = flux(u);
  if (std::abs(net) <= doubtful_net * gross + along_walls * reach) return "";
  // What enters and what leaves add up to the gross flux and differ by the net one.
  return fmt::format(
      "no boundary is open, and at t = {:g} s {:.6g} m²/s enter and {:.6g} m²/s leave, {:.2g} % of it too "
      "much: one vertex of given pressure takes the difference; give one boundary type = \"traction\", or "
      "balance the velocities",
      t, 0.5 * (gross - net), 0.5 * (gross + net), 200 * std::abs(net) / gross);
}

void Boundary::check_net_flux(double t, const Vector& u) const {
  if (!is_closed()) return;
  const auto [net, gross, reach] = flux(u);
  require(std::abs(net) <= largest_net * gross + along_walls * reach,
          "where no boundary is open, as much fluid must enter as leaves; at t = {:g} s a net {:g} m²/s {}: "
          "give one boundary type = \"traction\", or balance the velocities",
          t, std::abs(net), net > 0 ? "leaves" : "enters");
}

bool Boundary::traction_depends_on_time() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
    return part.type == Type::traction && (part.x.depends_on_time() || part.y.depends_on_time());
  });
}

/// Adds ∫ w·t over what the cover leaves of a part; n points out of the mesh.
void Boundary::add_traction(Index boundary, const Traction& traction, const Cover& cover,
                            Vector& load) const {
  for (std::size_t e = 0; e < mesh_.boundary.size(); ++e) {
    const BoundaryEdge& b = mesh_.boundary[e];
    if (b.boundary != boundary || cover.hides(e)) continue;
    const auto nodes = mesh_.edge_nodes(b);
    const EdgeNodes edge = mesh_.places(nodes);
    const Vec2 &from = mesh_.vertices[nodes[0]], &to = mesh_.vertices[nodes[1]];
    for (const auto& [start, end] : uncovered(from, to, cover.bodies))
      for (const LinePoint& point : gauss_legendre(4)) {
        const double s = start + point.s * (end - start);
        const Vec2 along = edge_tangent(edge, s);
        const Vec2 t = traction(edge_point(edge, s), Vec2(along.y(), -along.x()).normalized());
        const double weight = point.weight * (end - start) * along.norm();
        const auto n = edge_shape(s);
        for (int i = 0; i < 3; ++i) load.segment<2>(2 * mesh_.owner[nodes[i]]) += weight * n[i] * t;
      }
  }
}

Boundary::Traction Boundary::given_traction(Index boundary, double t) const {
  const Part& part = parts_[boundary];
  return [&part, t](const Vec2& x, const Vec2&) {
    return Vec2(part.x(x.x(), x.y(), t), part.y(x.x(), x.y(), t));
  };
}

void Boundary::add_tractions(double t, const Cover& cover, Vector& load) const {
  for (Index b = 0; b < static_cast<Index>(parts_.size()); ++b)
    if (is_open(b) && !(parts_[b].x.is_zero() && parts_[b].y.is_zero()))
      add_traction(b, given_traction(b, t), cover, load);
}

Vec2 Boundary::traction_force(Index boundary, double t, const Cover& cover) const {
  Vector load = Vector::Zero(2 * mesh_.n_nodes());
  add_traction(boundary, given_traction(boundary, t), cover, load);
  return load.reshaped(2, mesh_.n_nodes()).rowwise().sum();
}

void Boundary::add_pressure(Index boundary, const Cover& cover, Vector& load) const {
  add_traction(
      boundary, [](const Vec2&, const Vec2& normal) { return Vec2(-normal); }, cover, load);
}

}  // namespace fpi::fluid
