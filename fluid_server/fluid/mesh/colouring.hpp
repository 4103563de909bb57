/// Cells that may be assembled at the same time: the mesh is cut into stripes so wide that a colour shares
/// nodes with its two neighbours at most (around a period the last is a neighbour of the first). All even
/// ones, then all odd ones, can go in parallel; the sums come out the same to the bit however many threads
/// there are.
#pragma once

#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

struct Colouring {
  int n = 1;
  std::vector<std::uint8_t> of_cell;
};

Colouring make_colouring(const Mesh& mesh);

}  // namespace fpi::fluid
