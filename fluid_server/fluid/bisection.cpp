#include "fluid/bisection.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace fpi::fluid {

Bisection::Bisection(std::vector<Vec2> vertices, std::vector<std::array<Index, 3>> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  struct Side {
    std::array<Index, 2> vertices;
    Index triangle;
    int opposite;
  };
  std::vector<Side> sides;
  for (Index t = 0; t < n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]);
      sides.push_back({{a, b}, t, k});
    }
  std::ranges::sort(sides, {}, &Side::vertices);
  neighbours_.assign(triangles_.size(), {-1, -1, -1});
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &one = sides[i - 1], &other = sides[i];
    if (one.vertices != other.vertices) continue;
    neighbours_[one.triangle][one.opposite] = other.triangle;
    neighbours_[other.triangle][other.opposite] = one.triangle;
  }
}

void Bisection::bisect(Index t) {
  constexpr Index most = 5'000'000;
  if (n_triangles() >= most)
    fail("at most {:g} triangles are taken; the refinement asks for more: make its size larger",
         double{most});
  if (const Index n = neighbours_[t][2]; n != -1 && neighbours_[n][2] != t) bisect(n);
  const Index a = triangles_[t][0], b = triangles_[t][1], n = neighbours_[t][2];
  const Index middle = static_cast<Index>(vertices_.size());
  vertices_.push_back(0.5 * (vertices_[a] + vertices_[b]));
  const Index at_b = split(t, middle);
  if (n == -1) return;
  const Index at_a =
      split(n, middle);  // the half of n at a, since n runs from b to a; n itself is the one at b
  neighbours_[t][0] = at_a;
  neighbours_[at_a][1] = t;
  neighbours_[n][0] = at_b;
  neighbours_[at_b][1] = n;
}

/// Halves (a, b, c) into (c, a, middle), which keeps the number, and (b, c, middle), whose number is
/// returned.
Index Bisection::split(Index t, Index middle) {
  const auto [a, b, c] = triangles_[t];
  const Index beyond_bc = neighbours_[t][0], beyond_ca = neighbours_[t][1];
  const Index at_b = n_triangles();
  triangles_[t] = {c, a, middle};
  triangles_.push_back({b, c, middle});
  neighbours_[t] = {-1, at_b, beyond_ca};
  neighbours_.push_back({t, -1, beyond_bc});
  if (beyond_bc != -1) std::ranges::replace(neighbours_[beyond_bc], t, at_b);
  return at_b;
}

std::vector<std::array<Index, 2>> Bisection::boundary() const {
  std::vector<std::array<Index, 2>> edges;
  for (Index t = 0; t < n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (neighbours_[t][k] == -1) edges.push_back({triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]});
  return edges;
}

}  // namespace fpi::fluid
