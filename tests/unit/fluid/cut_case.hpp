/// What the tests of cut elements share: a square mesh, interfaces, and integrals over what bodies leave.
#pragma once

#include <cmath>
#include <numbers>

#include "fluid/cut/cut_mesh.hpp"
#include "fluid/mesh/rectangle.hpp"

namespace fpi::fluid {

inline constexpr double pi = std::numbers::pi;

inline Interface circle(const Vec2& centre, double radius, int n_arcs) {
  Interface out;
  out.surface = Disc{centre, radius};
  out.rigid.centre = centre;
  for (int a = 0; a < n_arcs; ++a) {
    out.start.push_back(2 * pi * a / n_arcs);
    out.end.push_back(2 * pi * (a + 1) / n_arcs);
  }
  return out;
}

/// A square [-1, 1]² of n × n cells.
struct Square {
  Mesh mesh;
  Locator locator;
  explicit Square(int n)
      : mesh(make_rectangle(uniform_lines(-1, 1, n), uniform_lines(-1, 1, n))), locator(mesh) {}
};

/// Integral of f over the part of the mesh that is in the fluid.
template <class F>
double integrate(const Mesh& mesh, const CutMesh& cut, F f) {
  double sum = 0;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (cut.state[c] != CellState::fluid) continue;
    const Triangle t(mesh.corners(c));
    for (const ElementPoint& p : standard_points()) sum += t.area * p.weight * f(t.point(p.shape.l));
  }
  for (const auto& cell : cut.cut_cells) {
    const Triangle t(mesh.corners(cell->cell));
    for (const ElementPoint& p : cell->points) sum += p.weight * f(t.point(p.shape.l));
  }
  return sum;
}

inline double arc_length(const CutMesh& cut) {
  double sum = 0;
  for (double length : cut.active_length) sum += length;
  return sum;
}

}  // namespace fpi::fluid
