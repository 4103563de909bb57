#include "fluid/stripes.hpp"

#include <algorithm>
#include <numeric>

namespace fpi::fluid {
namespace {

constexpr int most_stripes = 16;
constexpr int fewest_cells = 1000;  ///< of a stripe: fewer are done before a thread has started

/// Cells from one end of the longer side of the mesh to the other.
std::vector<Index> along_the_longer_side(const Mesh& mesh) {
  Vec2 lower = mesh.vertices.front(), upper = lower;
  for (const Vec2& x : mesh.vertices) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  const int axis = upper.x() - lower.x() >= upper.y() - lower.y() ? 0 : 1;
  std::vector<double> place(mesh.n_cells());
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    const auto corner = mesh.corners(c);
    place[c] = corner[0][axis] + corner[1][axis] + corner[2][axis];
  }
  std::vector<Index> order(mesh.n_cells());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return place[a] < place[b]; });
  return order;
}

bool only_neighbours_meet(const Mesh& mesh, const Stripes& stripes) {
  std::vector<std::uint8_t> first(mesh.n_vertices(), most_stripes), last(mesh.n_vertices(), 0);
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (Index v : mesh.cells[c]) {
      first[v] = std::min(first[v], stripes.of_cell[c]);
      last[v] = std::max(last[v], stripes.of_cell[c]);
    }
  for (Index v = 0; v < mesh.n_vertices(); ++v)
    if (last[v] > first[v] + 1) return false;
  return true;
}

}  // namespace

Stripes make_stripes(const Mesh& mesh) {
  const std::vector<Index> order = along_the_longer_side(mesh);
  Stripes stripes{std::clamp(mesh.n_cells() / fewest_cells, 1, most_stripes), {}};
  for (;; stripes.n /= 2) {
    stripes.of_cell.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      stripes.of_cell[order[k]] = static_cast<std::uint8_t>(k * stripes.n / order.size());
    if (stripes.n == 1 || only_neighbours_meet(mesh, stripes)) return stripes;
  }
}

}  // namespace fpi::fluid
