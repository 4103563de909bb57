/// The parts that bodies divide the fluid into: elements belong together where fluid passes the edge between
/// them. A pore that touching grains close off is a part of its own, with a pressure level of its own.
#pragma once

#include <span>
#include <vector>

#include "fluid/cut/cut_mesh.hpp"

namespace fpi::fluid {

struct Components {
  std::vector<Index> of_cell;  ///< number of the part that a cell belongs to; −1: it is not in the fluid
  std::vector<Index> of_boundary;  ///< the same for each Mesh::boundary; −1 also where bodies cover it all
  std::vector<Index> fullest;      ///< cell of each part with the largest share in the fluid
  std::vector<double> size;        ///< of each part: the sum of these shares, in elements
  Index n() const { return static_cast<Index>(size.size()); }
  /// The vertex at which the pressure of a part is pinned where nothing else gives its level.
  Index pin(const Mesh& mesh, Index part) const { return mesh.cell_vertices(fullest[part])[0]; }
};

Components find_components(const Mesh& mesh, const CutMesh& cut);

/// Takes parts smaller than an element out of the fluid: in a pocket that small no flow is resolved, and
/// where its arcs are too short to count its velocity is not determined. Bodies feel nothing there.
void drop_pockets(const Mesh& mesh, std::span<const Interface> interfaces, Components& components,
                  CutMesh& cut);

}  // namespace fpi::fluid
