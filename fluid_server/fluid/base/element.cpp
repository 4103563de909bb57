#include "fluid/base/element.hpp"

#include "fluid/base/quadrature.hpp"

namespace fpi::fluid {

Triangle::Triangle(const std::array<Vec2, 3>& corners) : corner(corners) {
  const double twice_area = cross(corner[1] - corner[0], corner[2] - corner[0]);
  area = 0.5 * twice_area;
  for (int k = 0; k < 3; ++k) {
    const Vec2 opposite = corner[(k + 2) % 3] - corner[(k + 1) % 3];
    gradient[k] = Vec2(-opposite.y(), opposite.x()) / twice_area;
  }
}

std::array<double, 3> Triangle::barycentric(const Vec2& x) const {
  const double l1 = gradient[1].dot(x - corner[0]), l2 = gradient[2].dot(x - corner[0]);
  return {1 - l1 - l2, l1, l2};
}

Padded p2_at(const std::array<double, 3>& l) {
  Padded n = Padded::Zero();
  for (int k = 0; k < 3; ++k) {
    n[k] = l[k] * (2 * l[k] - 1);
    n[3 + k] = 4 * l[k] * l[(k + 1) % 3];
  }
  return n;
}

Shape shape_at(const std::array<double, 3>& l) {
  Shape s;
  s.n = p2_at(l);
  s.l = l;
  for (int k = 0; k < 3; ++k) {
    s.dn[k].setZero();
    s.dn[k][k] = 4 * l[k] - 1;
    s.dn[k][3 + k] = 4 * l[(k + 1) % 3];            // edge k joins vertices k and k + 1
    s.dn[k][3 + (k + 2) % 3] = 4 * l[(k + 2) % 3];  // edge k + 2 joins vertices k + 2 and k
  }
  return s;
}

Metric<double> metric_of(const Triangle& t) {
  return {{t.gradient[0].x(), t.gradient[1].x(), t.gradient[2].x()},
          {t.gradient[0].y(), t.gradient[1].y(), t.gradient[2].y()},
          t.area};
}

Metric<double> metric_at(const std::array<Vec2, 6>& nodes, const Shape& shape) {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();  // ∂x/∂L_1, ∂x/∂L_2 with L_0 = 1 − L_1 − L_2
  for (int i = 0; i < 6; ++i) {
    a += (shape.dn[1][i] - shape.dn[0][i]) * nodes[i];
    b += (shape.dn[2][i] - shape.dn[0][i]) * nodes[i];
  }
  const double determinant = cross(a, b);
  const Vec2 g1 = Vec2(b.y(), -b.x()) / determinant, g2 = Vec2(-a.y(), a.x()) / determinant;
  return {{-g1.x() - g2.x(), g1.x(), g2.x()}, {-g1.y() - g2.y(), g1.y(), g2.y()}, 0.5 * determinant};
}

Vec2 value_at(const std::array<Index, 6>& nodes, const Padded& n, const Vector& nodal) {
  Vec2 value = Vec2::Zero();
  for (int i = 0; i < 6; ++i) value += n[i] * nodal.segment<2>(2 * nodes[i]);
  return value;
}

Vec2 position_at(const std::array<Vec2, 6>& nodes, const Padded& n) {
  Vec2 x = Vec2::Zero();
  for (int i = 0; i < 6; ++i) x += n[i] * nodes[i];
  return x;
}

namespace {

std::vector<ElementPoint> with_shapes(std::span<const TrianglePoint> rule) {
  std::vector<ElementPoint> out;
  for (const TrianglePoint& p : rule) out.push_back({shape_at({p.l0, p.l1, p.l2}), p.weight});
  return out;
}

}  // namespace

std::span<const ElementPoint> standard_points() {
  static const std::vector<ElementPoint> points = with_shapes(triangle_degree_5);
  return points;
}

std::span<const ElementPoint> curved_points() {
  static const std::vector<ElementPoint> points = with_shapes(triangle_degree_6);
  return points;
}

}  // namespace fpi::fluid
