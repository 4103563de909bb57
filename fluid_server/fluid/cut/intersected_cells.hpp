/// Where surfaces lie in the mesh: the cells and nodes that each of them meets, found anew only where it was
/// not in the same place before.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fluid/geometry/interface.hpp"
#include "fluid/mesh/locator.hpp"
#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

struct IntersectedCells {
  Surface surface;
  std::vector<Index> cut, inside;  ///< cells, ascending; those only touched are in `cut`
  std::vector<Index> covered;      ///< nodes inside the body, ascending
};

/// A body as the mesh sees it: once, and again for each periodic side that it reaches over.
struct Image {
  Index interface;  ///< index in the list of interfaces
  Vec2 shift;       ///< from the body to its image, whole periods [m]
  std::shared_ptr<const IntersectedCells> intersected_cells;

  const Surface& surface() const { return intersected_cells->surface; }  ///< shifted
};

/// Of all interfaces, in their order; an image that was in the same place `before` shares its intersected
/// cells.
std::vector<Image> images(const Mesh& mesh, const Locator& locator, std::span<const Interface> interfaces,
                          std::span<const Image> before);
std::vector<Surface> surfaces(std::span<const Image> images);

/// Arc length that suits the mesh around a surface: `ratio` times the mean size h of the elements it cuts; 0
/// outside the mesh.
double wanted_arc_length(const Mesh& mesh, const Locator& locator, const Surface& surface, double ratio);

}  // namespace fpi::fluid
