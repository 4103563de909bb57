#include "fluid/discretisation/space.hpp"

#include <algorithm>

namespace fpi::fluid {

Space::Space(Mesh mesh_in, const std::map<std::string, scene::Boundary>& conditions)
    : mesh(std::move(mesh_in)),
      locator(mesh),
      boundary(mesh, conditions),
      colouring(make_colouring(mesh)),
      smallest_size(mesh.size(0)),
      curved_index_(mesh.n_cells(), -1) {
  triangles.reserve(mesh.n_cells());
  metrics.reserve(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    triangles.emplace_back(mesh.corners(c));
    metrics.push_back(metric_of(triangles[c]));
    smallest_size = std::min(smallest_size, mesh.size(c));
    if (!mesh.is_curved(c)) continue;
    curved_index_[c] = static_cast<Index>(curved_metrics_.size());
    curved_metrics_.emplace_back();
    const auto nodes = mesh.cell_places(c);
    for (const ElementPoint& point : curved_points())
      curved_metrics_.back().push_back(metric_at(nodes, point.shape));
  }
}

}  // namespace fpi::fluid
