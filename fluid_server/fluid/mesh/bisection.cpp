#include "fluid/mesh/bisection.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace fpi::fluid {

Bisection::Bisection(std::vector<Vec2> vertices, std::vector<std::array<Index, 3>> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  std::vector<Side> sides;
  for (Index t = 0; t < n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      sides.push_back(side(t, k));
      std::ranges::sort(sides.back().vertices);
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

Bisection::Side Bisection::side(Index t, int k) const {
  return {{triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]}, t, k};
}

/// True where no triangle, or none that has the side's own vertices, is beyond.
bool Bisection::is_outer(const Side& side) const {
  const Index beyond = neighbours_[side.triangle][side.opposite];
  return beyond == -1 || std::ranges::any_of(side.vertices, [&](Index v) {
           return std::ranges::find(triangles_[beyond], v) == triangles_[beyond].end();
         });
}

void Bisection::join_sides(int axis) {
  const auto [lowest, highest] =
      std::ranges::minmax(vertices_, {}, [axis](const Vec2& x) { return x[axis]; });
  const std::array<double, 2> places{lowest[axis], highest[axis]};
  std::array<std::vector<Side>, 2> found;
  for (Index t = 0; t < n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      for (int end : {0, 1})
        if (const Side s = side(t, k);
            std::ranges::all_of(s.vertices, [&](Index v) { return vertices_[v][axis] == places[end]; }))
          found[end].push_back(s);
  for (auto& sides : found)
    std::ranges::sort(sides, {}, [&](const Side& s) {
      return vertices_[s.vertices[0]][1 - axis] + vertices_[s.vertices[1]][1 - axis];
    });
  require(found[0].size() == found[1].size(), "sides that are joined must match; they have {} and {} edges",
          found[0].size(), found[1].size());
  for (std::size_t i = 0; i < found[0].size(); ++i) {
    const Side &one = found[0][i], &other = found[1][i];
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
  const Index middle = add_middle(a, b);
  const bool shares_it = !is_outer(side(t, 2));
  const Index at_b = split(t, middle);
  if (n == -1) return;
  const Index middle_beyond = shares_it ? middle : add_middle(triangles_[n][0], triangles_[n][1]);
  const Index at_a =
      split(n, middle_beyond);  // the half of n at a, since n runs from b to a; n itself is the one at b
  neighbours_[t][0] = at_a;
  neighbours_[at_a][1] = t;
  neighbours_[n][0] = at_b;
  neighbours_[at_b][1] = n;
}

Index Bisection::add_middle(Index a, Index b) {
  vertices_.push_back(0.5 * (vertices_[a] + vertices_[b]));
  return static_cast<Index>(vertices_.size()) - 1;
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
      if (const Side s = side(t, k); is_outer(s)) edges.push_back(s.vertices);
  return edges;
}

}  // namespace fpi::fluid
