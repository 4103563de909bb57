/// The fixed Eulerian mesh: triangles with numbered edges and a named outer boundary. P2 nodes are the
/// vertices followed by the middles of the edges (paper, figure 4); P1 nodes are the vertices. An edge whose
/// middle node lies off its chord is a parabola, and its triangles are isoparametric (P2 geometry). Nodes
/// that are the same in a periodic flow keep their places and share the unknowns of one of them, their owner.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fluid/base/period.hpp"
#include "fluid/base/types.hpp"
#include "fluid/mesh/isoparametric.hpp"

namespace fpi::fluid {

struct BoundaryEdge {
  Index edge;
  Index cell;      ///< the one triangle beside it
  Index boundary;  ///< index in Mesh::boundary_names
};

/// A rectangle along the axes.
struct Box {
  Vec2 lower, upper;  ///< corners [m]
  double area() const { return (upper - lower).prod(); }
};

struct Mesh {
  std::vector<Vec2> vertices;                    ///< [m]
  std::vector<std::array<Index, 3>> cells;       ///< vertices, counter-clockwise
  std::vector<std::array<Index, 2>> edges;       ///< vertices, the smaller number first
  std::vector<Vec2> middles;                     ///< of each edge: place of its middle node [m]
  std::vector<std::array<Index, 3>> cell_edges;  ///< edges 01, 12, 20 of each cell
  std::vector<std::array<Index, 2>> edge_cells;  ///< one or two cells, its own first; -1 outside
  std::vector<BoundaryEdge> boundary;
  std::vector<std::string> boundary_names;
  Period period;
  std::vector<Index>
      owner;  ///< of each node: the one whose unknowns it has; itself but on an upper periodic side

  Index n_vertices() const { return static_cast<Index>(vertices.size()); }
  Index n_cells() const { return static_cast<Index>(cells.size()); }
  Index n_edges() const { return static_cast<Index>(edges.size()); }
  Index n_nodes() const { return n_vertices() + n_edges(); }

  /// P2 nodes of a cell as placed: three vertices, then the middles of edges 01, 12, 20.
  std::array<Index, 6> placed_nodes(Index cell) const {
    const auto& v = cells[cell];
    const auto& e = cell_edges[cell];
    const Index n = n_vertices();
    return {v[0], v[1], v[2], n + e[0], n + e[1], n + e[2]};
  }
  /// The nodes that hold their unknowns.
  std::array<Index, 6> cell_nodes(Index cell) const {
    auto nodes = placed_nodes(cell);
    for (Index& node : nodes) node = owner[node];
    return nodes;
  }
  std::array<Index, 3> cell_vertices(Index cell) const {
    const auto& v = cells[cell];
    return {owner[v[0]], owner[v[1]], owner[v[2]]};
  }
  std::array<Vec2, 3> corners(Index cell) const {
    const auto& v = cells[cell];
    return {vertices[v[0]], vertices[v[1]], vertices[v[2]]};
  }
  Vec2 node_position(Index node) const {
    return node < n_vertices() ? vertices[node] : middles[node - n_vertices()];
  }
  Vec2 chord_middle(Index edge) const { return 0.5 * (vertices[edges[edge][0]] + vertices[edges[edge][1]]); }
  /// Straight edges have their middle on the chord to the bit.
  bool is_curved_edge(Index edge) const { return middles[edge] != chord_middle(edge); }
  bool is_curved(Index cell) const {
    const auto& e = cell_edges[cell];
    return is_curved_edge(e[0]) || is_curved_edge(e[1]) || is_curved_edge(e[2]);
  }
  CellNodes cell_places(Index cell) const {
    const auto c = corners(cell);
    const auto& e = cell_edges[cell];
    return {c[0], c[1], c[2], middles[e[0]], middles[e[1]], middles[e[2]]};
  }
  Index owner_of_edge(Index edge) const { return owner[n_vertices() + edge] - n_vertices(); }
  /// What brings the second cell of an edge beside the first: zero but across a periodic side [m].
  Vec2 shift_across(Index edge) const {
    const auto& e = cell_edges[edge_cells[edge][1]];
    const auto is_same = [&](Index other) { return owner_of_edge(other) == owner_of_edge(edge); };
    return middles[edge] - middles[is_same(e[0]) ? e[0] : is_same(e[1]) ? e[1] : e[2]];
  }
  /// P2 nodes of an edge as placed: its vertices and its middle.
  std::array<Index, 3> edge_nodes(Index edge) const {
    return {edges[edge][0], edges[edge][1], n_vertices() + edge};
  }
  /// The same in the way round its triangle, so that the outside is to the right.
  std::array<Index, 3> edge_nodes(const BoundaryEdge& b) const {
    const auto& v = cells[b.cell];
    const int k = cell_edges[b.cell][0] == b.edge ? 0 : cell_edges[b.cell][1] == b.edge ? 1 : 2;
    return {v[k], v[(k + 1) % 3], n_vertices() + b.edge};
  }
  EdgeNodes places(const std::array<Index, 3>& edge_nodes) const {
    return {vertices[edge_nodes[0]], vertices[edge_nodes[1]], node_position(edge_nodes[2])};
  }
  /// Of the triangle through the corners [m²].
  double area(Index cell) const {
    const auto c = corners(cell);
    return 0.5 * cross(c[1] - c[0], c[2] - c[0]);
  }
  /// The rectangle around the mesh.
  Box box() const;
  /// Local element size h = √(2·area) [m].
  double size(Index cell) const { return std::sqrt(2 * area(cell)); }
};

/// A boundary edge by its vertices, as mesh files and generators know it.
struct NamedEdge {
  std::array<Index, 2> vertices;
  Index boundary;
};

/// The place of an edge's middle node [m]; edges without one are straight.
struct EdgeMiddle {
  std::array<Index, 2> vertices;
  Vec2 place;
};

/// Numbers the edges and checks the mesh: triangles turned counter-clockwise, no degenerate or folded
/// triangle, every outer edge named (by the first of its names), no more than two triangles an edge. Middles
/// less than 1e-9 of an edge off its chord are put there. Throws Error naming the place.
Mesh make_mesh(std::vector<Vec2> vertices, std::vector<std::array<Index, 3>> cells,
               const std::vector<NamedEdge>& named_edges, std::vector<std::string> boundary_names,
               const std::vector<EdgeMiddle>& middles = {});

/// Throws Error with the place where a triangle is folded by its curved edges, or turned over.
void check_not_folded(const Mesh& mesh);

}  // namespace fpi::fluid
