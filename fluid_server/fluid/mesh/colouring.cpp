#include "fluid/mesh/colouring.hpp"

#include <algorithm>
#include <numeric>

namespace fpi::fluid {
namespace {

constexpr int most_colours = 16;
constexpr int fewest_cells = 1000;  ///< of a colour: fewer are done before a thread has started

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

/// True where no vertex has cells of two even colours, or of two odd ones.
bool alike_are_apart(const Mesh& mesh, const Colouring& colouring) {
  constexpr std::uint8_t none = most_colours;
  std::vector<std::array<std::uint8_t, 2>> met(mesh.n_vertices(), {none, none});
  for (Index c = 0; c < mesh.n_cells(); ++c)
    for (Index v : mesh.cell_vertices(c)) {
      const std::uint8_t colour = colouring.of_cell[c];
      std::uint8_t& alike = met[v][colour % 2];
      if (alike != none && alike != colour) return false;
      alike = colour;
    }
  return true;
}

}  // namespace

Colouring make_colouring(const Mesh& mesh) {
  const std::vector<Index> order = along_the_longer_side(mesh);
  Colouring colouring{std::clamp(mesh.n_cells() / fewest_cells, 1, most_colours), {}};
  if (colouring.n > 1) colouring.n -= colouring.n % 2;  // around a period the last one meets the first
  for (;; colouring.n /= 2) {
    colouring.of_cell.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
      colouring.of_cell[order[k]] = static_cast<std::uint8_t>(k * colouring.n / order.size());
    if (colouring.n == 1 || alike_are_apart(mesh, colouring)) return colouring;
  }
}

}  // namespace fpi::fluid
