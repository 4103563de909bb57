/// Local refinement by newest-vertex bisection: a triangle is halved from its newest vertex through the edge
/// opposite, after its neighbour there shares that edge as its own, so that no hanging node appears
/// (Mitchell, A comparison of adaptive refinement techniques, ACM TOMS 15, 1989). Right triangles stay right.
#pragma once

#include <array>
#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

class Bisection {
 public:
  /// Counter-clockwise triangles whose third vertex counts as the newest: each pair of triangles must share
  /// its edge 01, or have it on the boundary, as halves of rectangles cut along a diagonal do.
  Bisection(std::vector<Vec2> vertices, std::vector<std::array<Index, 3>> triangles);

  /// Makes the outermost sides across an axis (0: x, 1: y) one: what is halved on one is halved on the other.
  /// They must match; no triangle may be its neighbour's neighbour twice.
  void join_sides(int axis);

  /// Halves a triangle, and neighbours where conformity asks for it. The triangle's number becomes one half;
  /// the other and those of neighbours are numbered from n_triangles() on. Throws Error beyond 5e6 triangles.
  void bisect(Index triangle);

  Index n_triangles() const { return static_cast<Index>(triangles_.size()); }
  const std::array<Index, 3>& triangle(Index t) const { return triangles_[t]; }
  const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
  const std::vector<Vec2>& vertices() const { return vertices_; }
  /// Edges at which the triangles end, with the triangle to their left; joined sides are among them.
  std::vector<std::array<Index, 2>> boundary() const;

 private:
  /// A triangle's side, opposite one of its vertices.
  struct Side {
    std::array<Index, 2> vertices;  ///< counter-clockwise
    Index triangle;
    int opposite;
  };
  Side side(Index triangle, int opposite) const;
  bool is_outer(const Side& side) const;
  Index add_middle(Index a, Index b);
  Index split(Index triangle, Index middle);

  std::vector<Vec2> vertices_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<std::array<Index, 3>> neighbours_;  // across the edge opposite each vertex; -1 outside
};

}  // namespace fpi::fluid
