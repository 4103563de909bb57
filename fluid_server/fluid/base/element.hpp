/// The P2P1 element (paper, figure 4, eq. 12): shape functions in barycentric terms, and the geometry of
/// straight and of isoparametric triangles. Arrays over the six P2 nodes are padded to eight, to fill vector
/// registers.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

using Padded = Eigen::Matrix<double, 8, 1>;

/// A straight triangle: barycentric gradients and area.
struct Triangle {
  std::array<Vec2, 3> corner;
  std::array<Vec2, 3> gradient;  ///< ∇L_k [1/m]
  double area;                   ///< [m²]

  explicit Triangle(const std::array<Vec2, 3>& corners);

  /// L_0, L_1, L_2 at x.
  std::array<double, 3> barycentric(const Vec2& x) const;
  Vec2 point(const std::array<double, 3>& l) const {
    return l[0] * corner[0] + l[1] * corner[1] + l[2] * corner[2];
  }
};

/// Shape functions and their derivatives at one quadrature point, in barycentric terms.
struct Shape {
  Padded n;                  ///< N_i, P2
  std::array<Padded, 3> dn;  ///< ∂N_i/∂L_k
  std::array<double, 3> l;   ///< L_k, which are the P1 functions too
};

/// N_i = L_i (2 L_i − 1) at vertices, 4 L_a L_b at the middles of edges 01, 12, 20.
Shape shape_at(const std::array<double, 3>& barycentric);

/// N_i alone.
Padded p2_at(const std::array<double, 3>& barycentric);

/// The geometry of an element at a point: ∇L_k [1/m], and the area [m²] that weights adding up to 1 are to be
/// multiplied by. Constant in a straight triangle.
template <class T>
struct Metric {
  std::array<T, 3> gx, gy;
  T area;
};
Metric<double> metric_of(const Triangle& triangle);
/// Of the isoparametric triangle through its six P2 nodes, at a point of it.
Metric<double> metric_at(const std::array<Vec2, 6>& nodes, const Shape& shape);
/// Σ N_i u_i of a field with x, y of each node.
Vec2 value_at(const std::array<Index, 6>& nodes, const Padded& n, const Vector& nodal);
/// Σ N_i x_i
Vec2 position_at(const std::array<Vec2, 6>& nodes, const Padded& n);

/// A quadrature point of an element.
struct ElementPoint {
  Shape shape;
  double weight;  ///< [m²]
};

/// The rule of degree 5 that every uncut element shares; weights add up to 1 and are to be multiplied by the
/// area.
std::span<const ElementPoint> standard_points();

/// The rule of degree 6 for curved elements; the products of degree 5 get the Jacobian on top.
std::span<const ElementPoint> curved_points();

}  // namespace fpi::fluid
