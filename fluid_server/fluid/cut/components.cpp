#include "fluid/cut/components.hpp"

#include <utility>

#include "fluid/base/disjoint_sets.hpp"

namespace fpi::fluid {
namespace {

/// True where bodies cover the whole edge, so that no fluid passes.
bool is_blocked(const Mesh& mesh, Index edge, std::span<const Surface> surfaces) {
  return uncovered(mesh.vertices[mesh.edges[edge][0]], mesh.vertices[mesh.edges[edge][1]], surfaces).empty();
}

/// The part of each active cell that is in the fluid.
std::vector<double> fluid_shares(const Mesh& mesh, const CutMesh& cut) {
  std::vector<double> share(mesh.n_cells(), 1);
  for (const auto& cell : cut.cut_cells) share[cell->cell] = cell->share;
  return share;
}

}  // namespace

Components find_components(const Mesh& mesh, const CutMesh& cut) {
  const std::vector<Surface> bodies = surfaces(cut.images);
  DisjointSets parts(mesh.n_cells());
  for (Index e = 0; e < mesh.n_edges(); ++e) {
    const auto [c1, c2] = mesh.edge_cells[e];
    if (c2 == -1 || !cut.is_active(c1) || !cut.is_active(c2)) continue;
    const bool near_body = cut.state[c1] == CellState::cut && cut.state[c2] == CellState::cut;
    if (!near_body || !is_blocked(mesh, e, bodies)) parts.join(c1, c2);
  }
  Components out;
  out.of_cell.assign(mesh.n_cells(), -1);
  std::vector<Index> number(mesh.n_cells(), -1);
  const std::vector<double> share = fluid_shares(mesh, cut);
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!cut.is_active(c)) continue;
    Index& part = number[parts.find(c)];
    if (part < 0) {
      part = out.n();
      out.fullest.push_back(c);
      out.size.push_back(0);
    }
    out.of_cell[c] = part;
    out.size[part] += share[c];
    if (share[c] > share[out.fullest[part]]) out.fullest[part] = c;
  }
  for (const BoundaryEdge& b : mesh.boundary) {
    const bool covered = cut.state[b.cell] == CellState::cut && is_blocked(mesh, b.edge, bodies);
    out.of_boundary.push_back(covered ? -1 : out.of_cell[b.cell]);
  }
  return out;
}

void drop_pockets(const Mesh& mesh, std::span<const Interface> interfaces, Components& components,
                  CutMesh& cut) {
  Components kept;
  std::vector<Index> number(components.n(), -1);
  for (Index part = 0; part < components.n(); ++part) {
    if (components.size[part] < 1) continue;
    number[part] = kept.n();
    kept.fullest.push_back(components.fullest[part]);
    kept.size.push_back(components.size[part]);
  }
  if (kept.n() == components.n()) return;
  const auto renumber = [&](const std::vector<Index>& from, std::vector<Index>& to) {
    for (const Index part : from) to.push_back(part < 0 ? -1 : number[part]);
  };
  renumber(components.of_cell, kept.of_cell);
  renumber(components.of_boundary, kept.of_boundary);
  components = std::move(kept);
  const auto is_gone = [&](Index c) { return components.of_cell[c] < 0; };
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (is_gone(c)) cut.state[c] = CellState::solid;
  std::erase_if(cut.cut_cells, [&](const auto& cell) { return is_gone(cell->cell); });
  std::erase_if(cut.ghost_faces, [&](const auto& face) {
    const auto [c1, c2] = mesh.edge_cells[face->edge];
    return is_gone(c1) || is_gone(c2);
  });
  std::erase_if(cut.pieces, [&](const ArcPiece& piece) { return is_gone(piece.cell); });
  measure_multipliers(interfaces, cut);
}

}  // namespace fpi::fluid
