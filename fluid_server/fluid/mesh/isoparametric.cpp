#include "fluid/mesh/isoparametric.hpp"

#include <algorithm>
#include <cmath>

#include "fluid/base/element.hpp"

namespace fpi::fluid {

std::optional<Barycentric> isoparametric_inverse(const CellNodes& nodes, const Vec2& x) {
  constexpr int most_iterations = 20;
  constexpr double small = 1e-9, too_far = 2;  // a step this small is followed by one of its square
  Barycentric l{1.0 / 3, 1.0 / 3, 1.0 / 3};
  for (int i = 0; i < most_iterations; ++i) {
    const Shape shape = shape_at(l);
    const Metric<double> metric = metric_at(nodes, shape);
    if (!(metric.area > 0)) return std::nullopt;
    const Vec2 miss = x - position_at(nodes, shape.n);
    double largest_step = 0, largest = 0;
    for (int k = 0; k < 3; ++k) {
      const double step = metric.gx[k] * miss.x() + metric.gy[k] * miss.y();
      l[k] += step;
      largest_step = std::max(largest_step, std::abs(step));
      largest = std::max(largest, std::abs(l[k]));
    }
    if (largest_step < small) return l;
    if (largest > too_far) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Vec2> folded_place(const CellNodes& nodes) {
  std::vector<Shape> shapes;
  for (int k = 0; k < 3; ++k) {
    Barycentric corner{0, 0, 0}, middle{0.5, 0.5, 0.5};
    corner[k] = 1;
    middle[k] = 0;
    shapes.push_back(shape_at(corner));
    shapes.push_back(shape_at(middle));
  }
  for (const ElementPoint& point : curved_points()) shapes.push_back(point.shape);
  for (const Shape& shape : shapes)
    if (!(metric_at(nodes, shape).area > 0)) return position_at(nodes, shape.n);
  return std::nullopt;
}

std::array<double, 3> edge_shape(double s) {
  return {(1 - s) * (1 - 2 * s), s * (2 * s - 1), 4 * s * (1 - s)};
}

Vec2 edge_point(const EdgeNodes& nodes, double s) {
  const auto n = edge_shape(s);
  return n[0] * nodes[0] + n[1] * nodes[1] + n[2] * nodes[2];
}

Vec2 edge_tangent(const EdgeNodes& nodes, double s) {
  return (4 * s - 3) * nodes[0] + (4 * s - 1) * nodes[1] + (4 - 8 * s) * nodes[2];
}

}  // namespace fpi::fluid
