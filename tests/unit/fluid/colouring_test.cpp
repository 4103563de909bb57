#include "fluid/mesh/colouring.hpp"

#include <gtest/gtest.h>

#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {
namespace {

void expect_only_neighbours_to_meet(const Mesh& mesh, const Colouring& colouring) {
  std::vector<std::pair<int, int>> range(mesh.n_nodes(), {255, 0});
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (Index node : mesh.cell_nodes(c)) {
      range[node].first = std::min<int>(range[node].first, colouring.of_cell[c]);
      range[node].second = std::max<int>(range[node].second, colouring.of_cell[c]);
    }
  for (const auto& [first, last] : range) EXPECT_LE(last, first + 1);
}

TEST(Colouring, share_nodes_with_their_neighbours_only) {
  const Mesh mesh = make_rectangle(uniform_lines(0, 3, 150), uniform_lines(0, 1, 40));
  const Colouring colouring = make_colouring(mesh);
  EXPECT_GT(colouring.n, 8);
  expect_only_neighbours_to_meet(mesh, colouring);
}

TEST(Colouring, are_few_where_elements_are_long) {
  const Mesh mesh = make_rectangle(uniform_lines(0, 3, 2), uniform_lines(0, 1, 1500));
  expect_only_neighbours_to_meet(mesh, make_colouring(mesh));
}

}  // namespace
}  // namespace fpi::fluid
