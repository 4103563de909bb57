#include "fluid/element.hpp"

#include "fluid/quadrature.hpp"

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

std::span<const ElementPoint> standard_points() {
  static const std::vector<ElementPoint> points = [] {
    std::vector<ElementPoint> out;
    for (const TrianglePoint& p : triangle_degree_5) out.push_back({shape_at({p.l0, p.l1, p.l2}), p.weight});
    return out;
  }();
  return points;
}

}  // namespace fpi::fluid
