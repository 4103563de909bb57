#include "fluid/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

std::uint64_t edge_key(Index a, Index b) {
  if (a > b) std::swap(a, b);
  return (static_cast<std::uint64_t>(a) << 32) | static_cast<std::uint32_t>(b);
}

void orient(Mesh& mesh) {
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    for (Index v : mesh.cells[c])
      require(v >= 0 && v < mesh.n_vertices(),
              "triangle {} refers to vertex {}, but there are {}: repair the mesh", c, v, mesh.n_vertices());
    const auto corner = mesh.corners(c);
    const double twice_area = 2 * mesh.area(c);
    const double side =
        std::max((corner[1] - corner[0]).squaredNorm(), (corner[2] - corner[0]).squaredNorm());
    require(std::abs(twice_area) > 1e-12 * side,
            "triangles must have an area; triangle {} at ({:g}, {:g}) m is degenerate: repair the mesh", c,
            corner[0].x(), corner[0].y());
    if (twice_area < 0) std::swap(mesh.cells[c][1], mesh.cells[c][2]);
  }
}

std::unordered_map<std::uint64_t, Index> number_edges(Mesh& mesh) {
  std::unordered_map<std::uint64_t, Index> number;
  number.reserve(2 * mesh.cells.size());
  mesh.cell_edges.resize(mesh.cells.size());
  std::vector<Index> first_vertex;  // from which the first triangle of an edge runs along it
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    for (int k = 0; k < 3; ++k) {
      const Index a = mesh.cells[c][k], b = mesh.cells[c][(k + 1) % 3];
      const auto [it, is_new] = number.try_emplace(edge_key(a, b), mesh.n_edges());
      const Index edge = it->second;
      if (is_new) {
        mesh.edges.push_back({std::min(a, b), std::max(a, b)});
        mesh.edge_cells.push_back({c, -1});
        first_vertex.push_back(a);
      } else {
        require(mesh.edge_cells[edge][1] == -1,
                "an edge may have two triangles; the one from ({:g}, {:g}) to ({:g}, {:g}) m has more: "
                "repair the mesh",
                mesh.vertices[a].x(), mesh.vertices[a].y(), mesh.vertices[b].x(), mesh.vertices[b].y());
        require(first_vertex[edge] != a,
                "the triangles at an edge must lie on either side of it; those from ({:g}, {:g}) to ({:g}, "
                "{:g}) m "
                "overlap: repair the mesh",
                mesh.vertices[a].x(), mesh.vertices[a].y(), mesh.vertices[b].x(), mesh.vertices[b].y());
        mesh.edge_cells[edge][1] = c;
      }
      mesh.cell_edges[c][k] = edge;
    }
  }
  return number;
}

}  // namespace

Mesh make_mesh(std::vector<Vec2> vertices, std::vector<std::array<Index, 3>> cells,
               const std::vector<NamedEdge>& named_edges, std::vector<std::string> boundary_names) {
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.cells = std::move(cells);
  mesh.boundary_names = std::move(boundary_names);
  orient(mesh);
  const auto number = number_edges(mesh);
  for (Index e = 0; e < mesh.n_edges(); ++e) mesh.middles.push_back(mesh.chord_middle(e));

  std::vector<Index> boundary_of(mesh.edges.size(), -1);
  for (const NamedEdge& named : named_edges) {
    const auto it = number.find(edge_key(named.vertices[0], named.vertices[1]));
    require(it != number.end(), "the boundary \"{}\" has an edge that no triangle has: repair the mesh",
            mesh.boundary_names[named.boundary]);
    boundary_of[it->second] = named.boundary;
  }
  for (Index e = 0; e < mesh.n_edges(); ++e) {
    if (mesh.edge_cells[e][1] != -1) continue;
    const Vec2 a = mesh.vertices[mesh.edges[e][0]], b = mesh.vertices[mesh.edges[e][1]];
    require(boundary_of[e] != -1,
            "every outer edge must belong to a named boundary; the one from ({:g}, {:g}) to ({:g}, {:g}) m "
            "does not: "
            "add it to a physical group",
            a.x(), a.y(), b.x(), b.y());
    mesh.boundary.push_back({e, mesh.edge_cells[e][0], boundary_of[e]});
  }
  return mesh;
}

}  // namespace fpi::fluid
