#include "fluid/discretisation/numbering.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

namespace fpi::fluid {
namespace {

/// One vertex of each part of the fluid that no open boundary gives a pressure level, away from bodies where
/// the part has a whole element.
std::vector<Index> pinned_vertices(const Mesh& mesh, const Components& components,
                                   const std::vector<std::uint8_t>& is_open) {
  std::vector<Index> pinned;
  for (Index part = 0; part < components.n(); ++part)
    if (!is_open[part]) pinned.push_back(components.pin(mesh, part));
  return pinned;
}

}  // namespace

Numbering number_unknowns(const Mesh& mesh, const Boundary& boundary, const CutMesh& cut,
                          const Components& components, const std::vector<Interface>& interfaces) {
  constexpr Index absent = -1, wanted = 0;
  Numbering out;
  out.velocity.assign(2 * static_cast<std::size_t>(mesh.n_nodes()), absent);
  out.pressure.assign(mesh.n_vertices(), absent);
  out.multiplier.assign(2 * static_cast<std::size_t>(cut.n_multipliers()), absent);
  out.node_is_active.assign(mesh.n_nodes(), 0);

  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!cut.is_active(c)) continue;
    for (Index node : mesh.cell_nodes(c)) out.node_is_active[node] = 1;
    for (Index v : mesh.cell_vertices(c)) out.pressure[v] = wanted;
  }
  out.pinned = pinned_vertices(mesh, components, boundary.open_components(components));
  for (Index v : out.pinned) out.pressure[v] = absent;
  for (std::size_t i = 0; i < cut.multiplier_nodes.size(); ++i) {
    Index m = cut.first_multiplier[i];
    for (const double length : cut.multiplier_nodes[i].lengths()) {
      if (cut.active_length[m] > 0.05 * length) out.multiplier[2 * m] = out.multiplier[2 * m + 1] = wanted;
      ++m;
    }
  }

  const auto close_cluster = [&out] {
    const Index first = out.clusters.empty() ? 0 : out.clusters.back().end;
    if (out.n_equations > first) out.clusters.push_back({first, out.n_equations});
  };
  // Cell by cell, so that what an element couples lies close together in the matrix.
  std::vector<std::uint8_t> is_numbered(mesh.n_nodes(), 0);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!cut.is_active(c)) continue;
    for (Index node : mesh.cell_nodes(c)) {
      if (std::exchange(is_numbered[node], 1)) continue;
      const Constraint constraint = boundary.constraint(node);
      if (constraint == Constraint::none) out.velocity[2 * node] = out.n_equations++;
      if (constraint != Constraint::both) out.velocity[2 * node + 1] = out.n_equations++;
      if (node < mesh.n_vertices() && out.pressure[node] == wanted) out.pressure[node] = out.n_equations++;
      close_cluster();
    }
  }
  for (Index m = 0; m < cut.n_multipliers(); ++m) {
    for (const Index i : {2 * m, 2 * m + 1})
      if (out.multiplier[i] == wanted) out.multiplier[i] = out.n_equations++;
    close_cluster();
  }
  for (const Interface& interface : interfaces) {
    for (int i = 0; i < 3; ++i) out.rigid.push_back(interface.balance ? out.n_equations++ : absent);
    close_cluster();
  }
  return out;
}

std::optional<Vec2> unheld_direction(const Boundary& boundary, const Numbering& numbering) {
  constexpr double straight = 1e-12;  // squared sine of the angle that a slip wall may turn by
  const auto in_system = [](Index equation) { return equation >= 0; };
  if (std::ranges::any_of(numbering.multiplier, in_system)) return std::nullopt;
  Eigen::Matrix2d held = Eigen::Matrix2d::Zero();
  for (std::size_t node = 0; node < numbering.node_is_active.size(); ++node) {
    const Constraint constraint = boundary.constraint(static_cast<Index>(node));
    if (numbering.node_is_active[node] == 0 || constraint == Constraint::none) continue;
    if (constraint == Constraint::both) return std::nullopt;
    const Vec2& normal = boundary.normal(static_cast<Index>(node));
    held += normal * normal.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(held);
  if (solver.eigenvalues()[0] > straight * solver.eigenvalues()[1]) return std::nullopt;
  return solver.eigenvectors().col(0);
}

}  // namespace fpi::fluid
