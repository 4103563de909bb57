/// Local refinement by newest-vertex bisection: a triangle is halved from its newest vertex through the edge
/// opposite, after its neighbour there shares that edge as its own, so that no hanging node appears
/// (Mitchell, A comparison of adaptive refinement techniques, ACM TOMS 15, 1989). Right triangles stay right.
#pragma once

#include <array>
#include <vector>

#include "fluid/types.hpp"

namespace fpi::fluid {

class Bisection {
 public:
  /// Counter-clockwise triangles whose third vertex counts as the newest: each pair of triangles must share
  /// its edge 01, or have it on the boundary, as halves of rectangles cut along a diagonal do.
  Bisection(std::vector<Vec2> vertices, std::vector<std::array<Index, 3>> triangles);

  /// Halves a triangle, and neighbours where conformity asks for it. The triangle's number becomes one half;
  /// the other and those of neighbours are numbered from n_triangles() on. Throws Error beyond 5e6 triangles.
  void bisect(Index triangle);

  Index n_triangles() const { return static_cast<Index>(triangles_.size()); }
  const std::array<Index, 3>& triangle(Index t) const { return triangles_[t]; }
  const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
  const std::vector<Vec2>& vertices() const { return vertices_; }
  /// Edges of one triangle only, with the triangle to their left.
  std::vector<std::array<Index, 2>> boundary() const;

 private:
  Index split(Index triangle, Index middle);

  std::vector<Vec2> vertices_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<std::array<Index, 3>> neighbours_;  // across the edge opposite each vertex; -1 outside
};

}  // namespace fpi::fluid
