#include "fluid/numbering.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>
#include <utility>

namespace fpi::fluid {
namespace {

/// Union–find with path halving.
class Components {
 public:
  explicit Components(Index n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(Index a, Index b) { parent_[find(a)] = find(b); }

 private:
  std::vector<Index> parent_;
};

/// True where bodies cover the whole edge, so that no fluid passes.
bool is_blocked(const Mesh& mesh, Index edge, std::span<const Outline> outlines) {
  return uncovered(mesh.vertices[mesh.edges[edge][0]], mesh.vertices[mesh.edges[edge][1]], outlines).empty();
}

/// One vertex of each fluid component that has no open boundary: its pressure is pinned.
std::vector<Index> pinned_vertices(const Mesh& mesh, const Boundary& boundary, const CutMesh& cut,
                                   std::span<const Outline> outlines) {
  Components components(mesh.n_cells());
  for (Index e = 0; e < mesh.n_edges(); ++e) {
    const auto [c1, c2] = mesh.edge_cells[e];
    if (c2 == -1 || !cut.is_active(c1) || !cut.is_active(c2)) continue;
    const bool near_body = cut.state[c1] == CellState::cut && cut.state[c2] == CellState::cut;
    if (!near_body || !is_blocked(mesh, e, outlines)) components.join(c1, c2);
  }
  std::vector<std::uint8_t> has_level(mesh.n_cells(), 0);
  for (const BoundaryEdge& b : mesh.boundary)
    if (cut.is_active(b.cell) && boundary.is_open(b.boundary) &&
        (cut.state[b.cell] == CellState::fluid || !is_blocked(mesh, b.edge, outlines)))
      has_level[components.find(b.cell)] = 1;
  std::vector<Index> pinned;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (cut.state[c] != CellState::fluid)
      continue;  // a cut element's corner may be held by the penalty alone
    const Index root = components.find(c);
    if (has_level[root]) continue;
    has_level[root] = 1;
    pinned.push_back(mesh.cell_vertices(c)[0]);
  }
  return pinned;
}

}  // namespace

Numbering number_unknowns(const Mesh& mesh, const Boundary& boundary, const CutMesh& cut) {
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
  out.pinned = pinned_vertices(mesh, boundary, cut, outlines(cut.images));
  for (Index v : out.pinned) out.pressure[v] = absent;
  for (std::size_t i = 0; i < cut.knots.size(); ++i) {
    Index m = cut.first_multiplier[i];
    for (const double length : cut.knots[i].lengths()) {
      if (cut.active_length[m] > 0.05 * length) out.multiplier[2 * m] = out.multiplier[2 * m + 1] = wanted;
      ++m;
    }
  }

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
    }
  }
  for (Index& equation : out.multiplier)
    if (equation == wanted) equation = out.n_equations++;
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
