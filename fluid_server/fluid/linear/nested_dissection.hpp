/// The order in which a direct solver is to eliminate the unknowns: nested dissection by METIS. It sees the
/// graph of the places they sit at, half as large as that of the unknowns, which makes it three times as fast
/// (docs/numerics.md, "The order of elimination").
#pragma once

#include <span>
#include <vector>

#include "fluid/linear/block_matrix.hpp"

namespace fpi::fluid {

/// Unknowns at one place, numbered one after another: from `first` to before `end`.
struct Cluster {
  Index first, end;
};

/// All unknowns but those kept for last, in an order that keeps the factors of a matrix of this (symmetric)
/// pattern small. No clusters: each unknown is one by itself.
std::vector<Index> nested_dissection(const BlockMatrix& matrix, std::span<const Cluster> clusters,
                                     std::span<const Index> last);

}  // namespace fpi::fluid
