#include "fluid/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

using EdgeNumbers = std::unordered_map<std::uint64_t, Index>;  // by edge_key

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

EdgeNumbers number_edges(Mesh& mesh) {
  EdgeNumbers number;
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
                "{:g}) m overlap: repair the mesh",
                mesh.vertices[a].x(), mesh.vertices[a].y(), mesh.vertices[b].x(), mesh.vertices[b].y());
        mesh.edge_cells[edge][1] = c;
      }
      mesh.cell_edges[c][k] = edge;
    }
  }
  return number;
}

void place_middles(Mesh& mesh, const EdgeNumbers& number, const std::vector<EdgeMiddle>& middles) {
  constexpr double straight = 1e-9;  // of the edge
  for (Index e = 0; e < mesh.n_edges(); ++e) mesh.middles.push_back(mesh.chord_middle(e));
  std::vector<bool> is_given(mesh.edges.size());
  for (const EdgeMiddle& middle : middles) {
    const auto it = number.find(edge_key(middle.vertices[0], middle.vertices[1]));
    require(
        it != number.end(),
        "a middle node belongs to an edge of a triangle; that at ({:g}, {:g}) m does not: repair the mesh",
        middle.place.x(), middle.place.y());
    const Index e = it->second;
    const double close =
        straight * (mesh.vertices[mesh.edges[e][1]] - mesh.vertices[mesh.edges[e][0]]).norm();
    require(!is_given[e] || (middle.place - mesh.middles[e]).norm() <= close,
            "an edge has one middle node; one edge has ({:g}, {:g}) and ({:g}, {:g}) m: repair the mesh",
            mesh.middles[e].x(), mesh.middles[e].y(), middle.place.x(), middle.place.y());
    is_given[e] = true;
    if (!((middle.place - mesh.chord_middle(e)).norm() <= close)) mesh.middles[e] = middle.place;
  }
}

[[noreturn]] void refuse_unnamed(const Mesh& mesh, Index edge) {
  const Vec2 a = mesh.vertices[mesh.edges[edge][0]], b = mesh.vertices[mesh.edges[edge][1]];
  const Vec2 place = mesh.chord_middle(edge);
  Index n_there = 0;
  for (Index e = 0; e < mesh.n_edges(); ++e) n_there += mesh.chord_middle(e) == place;
  fail(
      "every outer edge must belong to a named boundary; the one from ({:g}, {:g}) to ({:g}, {:g}) m does "
      "not: "
      "{}",
      a.x(), a.y(), b.x(), b.y(),
      n_there > 1 ? "another edge lies in its place, so the mesh is cut open there: merge nodes of one place "
                    "(Gmsh: Coherence Mesh)"
                  : "add it to a physical group");
}

void name_boundary(Mesh& mesh, const EdgeNumbers& number, const std::vector<NamedEdge>& named_edges) {
  std::vector<Index> boundary_of(mesh.edges.size(), -1);
  for (const NamedEdge& named : named_edges) {
    const auto it = number.find(edge_key(named.vertices[0], named.vertices[1]));
    require(it != number.end(), "the boundary \"{}\" has an edge that no triangle has: repair the mesh",
            mesh.boundary_names[named.boundary]);
    if (boundary_of[it->second] == -1) boundary_of[it->second] = named.boundary;
  }
  for (Index e = 0; e < mesh.n_edges(); ++e) {
    if (mesh.edge_cells[e][1] != -1) continue;
    if (boundary_of[e] == -1) refuse_unnamed(mesh, e);
    mesh.boundary.push_back({e, mesh.edge_cells[e][0], boundary_of[e]});
  }
  std::vector<std::uint8_t> has_edge(mesh.boundary_names.size(), 0);
  for (const BoundaryEdge& b : mesh.boundary) has_edge[b.boundary] = 1;
  for (std::size_t i = 0; i < has_edge.size(); ++i)
    require(has_edge[i] != 0,
            "every named boundary must have outer edges of its own; \"{}\" has none: remove this physical "
            "group, or name curves on the outside of the mesh",
            mesh.boundary_names[i]);
}

}  // namespace

Box Mesh::box() const {
  Box box{vertices.front(), vertices.front()};
  for (const Vec2& x : vertices) {
    box.lower = box.lower.cwiseMin(x);
    box.upper = box.upper.cwiseMax(x);
  }
  return box;
}

Mesh make_mesh(std::vector<Vec2> vertices, std::vector<std::array<Index, 3>> cells,
               const std::vector<NamedEdge>& named_edges, std::vector<std::string> boundary_names,
               const std::vector<EdgeMiddle>& middles) {
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.cells = std::move(cells);
  mesh.boundary_names = std::move(boundary_names);
  orient(mesh);
  const EdgeNumbers number = number_edges(mesh);
  place_middles(mesh, number, middles);
  check_not_folded(mesh);
  name_boundary(mesh, number, named_edges);
  mesh.owner.resize(mesh.n_nodes());
  std::iota(mesh.owner.begin(), mesh.owner.end(), 0);
  return mesh;
}

void check_not_folded(const Mesh& mesh) {
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    std::optional<Vec2> place;
    if (mesh.is_curved(c))
      place = folded_place(mesh.cell_places(c));
    else if (!(mesh.area(c) > 0))
      place = mesh.vertices[mesh.cells[c][0]];
    if (place)
      fail(
          "triangles must not be folded or turned over; triangle {} is at ({:g}, {:g}) m: refine the mesh "
          "there",
          c, place->x(), place->y());
  }
}

}  // namespace fpi::fluid
