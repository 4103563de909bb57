#include "fluid/linear/nested_dissection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace fpi::fluid {
namespace {

/// The five-point pattern on a grid, two unknowns a place.
struct Grid {
  static constexpr Index side = 24, places = side * side, n = 2 * places;
  BlockMask mask = BlockMask::dense(4);
  BlockMatrix matrix{n};
  std::vector<Cluster> clusters;

  Grid() {
    for (Index k = 0; k < places; ++k) {
      clusters.push_back({2 * k, 2 * k + 2});
      if (k % side + 1 < side) couple(k, k + 1);
      if (k + side < places) couple(k, k + side);
    }
    matrix.finish();
  }
  void couple(Index a, Index b) { matrix.declare(std::array{2 * a, 2 * a + 1, 2 * b, 2 * b + 1}, mask); }
  /// Entries of a factor: each unknown's later neighbours, once those eliminated before have made it new
  /// ones.
  std::size_t entries_of_factor(const std::vector<Index>& order) const {
    std::vector<Index> turn(n);
    for (Index k = 0; k < n; ++k) turn[order[k]] = k;
    std::vector<std::set<Index>> later(n);
    for (Index c = 0; c < n; ++c)
      for (Index k = matrix.column_start()[c]; k < matrix.column_start()[c + 1]; ++k)
        if (turn[matrix.row()[k]] > turn[c]) later[turn[c]].insert(turn[matrix.row()[k]]);
    std::size_t entries = 0;
    for (auto& neighbours : later) {
      entries += neighbours.size();
      if (neighbours.empty()) continue;
      const Index next = *neighbours.begin();
      neighbours.erase(neighbours.begin());
      later[next].insert(neighbours.begin(), neighbours.end());
    }
    return entries;
  }
};

std::vector<Index> natural(Index n) {
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

TEST(NestedDissection, halves_the_factor_of_a_grid_with_or_without_places) {
  const Grid grid;
  for (const auto& clusters : {grid.clusters, std::vector<Cluster>{}}) {
    const auto order = nested_dissection(grid.matrix, clusters, {});
    auto sorted = order;
    std::ranges::sort(sorted);
    EXPECT_EQ(sorted, natural(Grid::n));
    EXPECT_LT(2 * grid.entries_of_factor(order), grid.entries_of_factor(natural(Grid::n)));
  }
}

TEST(NestedDissection, leaves_out_what_is_kept_for_last) {
  const Grid grid;
  const std::vector<Index> last{100, 101, 300, 301};
  const auto order = nested_dissection(grid.matrix, grid.clusters, last);
  EXPECT_EQ(order.size(), Grid::n - last.size());
  EXPECT_EQ(std::ranges::find_first_of(order, last), order.end());
}

}  // namespace
}  // namespace fpi::fluid
