/// All that stays as it is for a whole run: mesh, element geometry, search grid and boundary conditions.
#pragma once

#include <algorithm>

#include "fluid/boundary.hpp"
#include "fluid/element.hpp"
#include "fluid/locator.hpp"
#include "fluid/mesh.hpp"

namespace fpi::fluid {

struct Space {
  Mesh mesh;
  Locator locator;
  Boundary boundary;
  std::vector<Triangle> triangles;
  double smallest_size;  ///< h of the smallest element [m]

  Space(Mesh mesh_in, const std::map<std::string, scene::Boundary>& conditions)
      : mesh(std::move(mesh_in)), locator(mesh), boundary(mesh, conditions) {
    triangles.reserve(mesh.n_cells());
    smallest_size = mesh.size(0);
    for (Index c = 0; c < mesh.n_cells(); ++c) {
      triangles.emplace_back(mesh.corners(c));
      smallest_size = std::min(smallest_size, mesh.size(c));
    }
  }
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;
};

}  // namespace fpi::fluid
