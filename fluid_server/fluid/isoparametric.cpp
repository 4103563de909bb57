#include "fluid/isoparametric.hpp"

#include <Eigen/LU>

#include "fluid/element.hpp"
#include "fluid/quadrature.hpp"

namespace fpi::fluid {

Vec2 isoparametric_point(const CellNodes& nodes, const Barycentric& l) {
  const Padded n = p2_at(l);
  Vec2 x = Vec2::Zero();
  for (int i = 0; i < 6; ++i) x += n[i] * nodes[i];
  return x;
}

Eigen::Matrix2d isoparametric_jacobian(const CellNodes& nodes, const Barycentric& l) {
  const Shape shape = shape_at(l);
  Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 2; ++k) jacobian.col(k) += (shape.dn[k + 1][i] - shape.dn[0][i]) * nodes[i];
  return jacobian;
}

std::optional<Barycentric> isoparametric_inverse(const CellNodes& nodes, const Vec2& x) {
  constexpr int most_iterations = 20;
  constexpr double small = 1e-9, too_far = 2;  // a step this small is followed by one of its square
  Barycentric l{1.0 / 3, 1.0 / 3, 1.0 / 3};
  for (int i = 0; i < most_iterations; ++i) {
    const Eigen::Matrix2d jacobian = isoparametric_jacobian(nodes, l);
    if (!(jacobian.determinant() > 0)) return std::nullopt;
    const Vec2 step = jacobian.inverse() * (x - isoparametric_point(nodes, l));
    l[1] += step.x();
    l[2] += step.y();
    l[0] = 1 - l[1] - l[2];
    if (step.norm() < small) return l;
    if (std::abs(l[1]) + std::abs(l[2]) > too_far) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Vec2> folded_place(const CellNodes& nodes) {
  const auto folded = [&](const Barycentric& l) {
    return !(isoparametric_jacobian(nodes, l).determinant() > 0);
  };
  for (int k = 0; k < 3; ++k) {
    Barycentric corner{0, 0, 0}, middle{0.5, 0.5, 0.5};
    corner[k] = 1;
    middle[(k + 2) % 3] = 0;
    if (folded(corner)) return nodes[k];
    if (folded(middle)) return nodes[3 + k];
  }
  for (const TrianglePoint& p : triangle_degree_5) {
    const Barycentric l{p.l0, p.l1, p.l2};
    if (folded(l)) return isoparametric_point(nodes, l);
  }
  return std::nullopt;
}

Vec2 edge_point(const EdgeNodes& nodes, double s) {
  return (1 - s) * (1 - 2 * s) * nodes[0] + s * (2 * s - 1) * nodes[1] + 4 * s * (1 - s) * nodes[2];
}

Vec2 edge_tangent(const EdgeNodes& nodes, double s) {
  return (4 * s - 3) * nodes[0] + (4 * s - 1) * nodes[1] + (4 - 8 * s) * nodes[2];
}

}  // namespace fpi::fluid
