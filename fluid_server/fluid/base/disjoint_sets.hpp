/// Numbers joined into sets, each of which is named by one of its members (union–find with path halving).
#pragma once

#include <numeric>
#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

class DisjointSets {
 public:
  explicit DisjointSets(Index n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  /// The member that names the set of a.
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(Index a, Index b) { parent_[find(a)] = find(b); }

 private:
  std::vector<Index> parent_;
};

}  // namespace fpi::fluid
