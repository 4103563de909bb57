#include "fluid/mesh/stripes.hpp"

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

/// True where no vertex has cells of two even stripes, or of two odd ones.
bool alike_are_apart(const Mesh& mesh, const Stripes& stripes) {
  constexpr std::uint8_t none = most_stripes;
  std::vector<std::array<std::uint8_t, 2>> met(mesh.n_vertices(), {none, none});
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (Index v : mesh.cell_vertices(c)) {
      const std::uint8_t stripe = stripes.of_cell[c];
      std::uint8_t& alike = met[v][stripe % 2];
      if (alike != none && alike != stripe) return false;
      alike = stripe;
    }
  return true;
}

}  // namespace

Stripes make_stripes(const Mesh& mesh) {
  const std::vector<Index> order = along_the_longer_side(mesh);
  Stripes stripes{std::clamp(mesh.n_cells() / fewest_cells, 1, most_stripes), {}};
  if (stripes.n > 1) stripes.n -= stripes.n % 2;  // around a period the last one meets the first
  for (;; stripes.n /= 2) {
    stripes.of_cell.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      stripes.of_cell[order[k]] = static_cast<std::uint8_t>(k * stripes.n / order.size());
    if (stripes.n == 1 || alike_are_apart(mesh, stripes)) return stripes;
  }
}

}  // namespace fpi::fluid
