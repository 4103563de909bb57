#include "fluid/mesh/circle_fit.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace fpi::fluid {

void fit_circle(Mesh& mesh, const std::string& boundary, const Vec2& centre, double radius) {
  const auto& names = mesh.boundary_names;
  const auto name = std::find(names.begin(), names.end(), boundary);
  require(name != names.end(), "the boundary \"{}\" of a circle must be in the mesh, which has {}: rename it",
          boundary, fmt::join(names, ", "));
  const auto on_circle = [&](const Vec2& x) -> Vec2 { return centre + radius * (x - centre).normalized(); };

  std::vector<bool> was_curved(mesh.edges.size()), is_round(mesh.edges.size());
  for (Index e = 0; e < mesh.n_edges(); ++e) was_curved[e] = mesh.is_curved_edge(e);
  std::vector<Vec2> moved = mesh.vertices;
  for (const BoundaryEdge& b : mesh.boundary) {
    if (b.boundary != name - names.begin()) continue;
    is_round[b.edge] = true;
    const auto& ends = mesh.edges[b.edge];
    const double length = (mesh.vertices[ends[1]] - mesh.vertices[ends[0]]).norm();
    for (const Index v : ends) {
      const Vec2 x = mesh.vertices[v];
      moved[v] = on_circle(x);
      require(
          (moved[v] - x).norm() <= 0.25 * length,
          "the boundary \"{}\" must be within a quarter of an edge of its circle; its vertex ({:g}, {:g}) m "
          "is {:g} m off, an edge there is {:g} m long: correct centre or radius, or refine the mesh",
          boundary, x.x(), x.y(), (moved[v] - x).norm(), length);
    }
  }
  mesh.vertices = std::move(moved);
  for (Index e = 0; e < mesh.n_edges(); ++e) {
    if (is_round[e])
      mesh.middles[e] = on_circle(mesh.chord_middle(e));
    else if (!was_curved[e])
      mesh.middles[e] = mesh.chord_middle(e);
  }
  check_not_folded(mesh);
}

}  // namespace fpi::fluid
