/// A ring of triangles between two circles, for tests of curved edges.
#pragma once

#include <cmath>
#include <numbers>

#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// `around` by `across` cells of two triangles, boundaries "inner" and "outer"; the edges on the circles are
/// parabolas through the middle of the arc, or straight.
inline Mesh make_ring(Index around, Index across, double inner, double outer, bool curved = true) {
  const auto place = [&](double i, double j) {
    const double angle = 2 * std::numbers::pi * i / around, r = inner + (outer - inner) * j / across;
    return Vec2(r * std::cos(angle), r * std::sin(angle));
  };
  const auto vertex = [&](Index i, Index j) { return j * around + i % around; };
  std::vector<Vec2> vertices;
  std::vector<std::array<Index, 3>> cells;
  std::vector<NamedEdge> edges;
  std::vector<EdgeMiddle> middles;
  for (Index j = 0; j <= across; ++j)
    for (Index i = 0; i < around; ++i) {
      vertices.push_back(place(i, j));
      if (j < across) {
        cells.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
        cells.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)});
      }
      if (j > 0 && j < across) continue;
      edges.push_back({{vertex(i, j), vertex(i + 1, j)}, j == 0 ? 0 : 1});
      if (curved) middles.push_back({edges.back().vertices, place(i + 0.5, j)});
    }
  return make_mesh(std::move(vertices), std::move(cells), edges, {"inner", "outer"}, middles);
}

}  // namespace fpi::fluid
