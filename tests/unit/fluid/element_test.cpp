#include "fluid/base/element.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/base/quadrature.hpp"

namespace fpi::fluid {
namespace {

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

void expect_exact(std::span<const TrianglePoint> rule, int degree) {
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b) {
      double sum = 0;
      for (const TrianglePoint& p : rule) sum += p.weight * std::pow(p.l0, a) * std::pow(p.l1, b);
      EXPECT_NEAR(sum, 2 * factorial(a) * factorial(b) / factorial(a + b + 2), 2e-15) << a << ' ' << b;
    }
}

TEST(Quadrature, triangle_rules_are_exact_to_their_degree) {
  expect_exact(triangle_degree_5, 5);
  expect_exact(triangle_degree_6, 6);
}

TEST(Element, the_metric_of_a_curved_triangle_adds_up_to_its_area) {
  // A parabolic side of height c over a chord of length 1 adds 2c/3.
  const double c = 0.1;
  const std::array<Vec2, 6> nodes{Vec2(0, 0),   Vec2(1, 0),   Vec2(0, 1),
                                  Vec2(.5, -c), Vec2(.5, .5), Vec2(0, .5)};
  double area = 0;
  for (const ElementPoint& point : curved_points()) area += point.weight * metric_at(nodes, point.shape).area;
  EXPECT_NEAR(area, 0.5 + 2 * c / 3, 1e-14);
}

TEST(Element, curved_gradients_are_exact_for_linear_functions) {
  const std::array<Vec2, 6> nodes{Vec2(0, 0),     Vec2(1, 0),     Vec2(0, 1),
                                  Vec2(.5, -.08), Vec2(.55, .52), Vec2(.03, .5)};
  for (const ElementPoint& point : curved_points()) {
    const Metric<double> m = metric_at(nodes, point.shape);
    Vec2 gradient = Vec2::Zero();
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 3; ++k)
        gradient += point.shape.dn[k][i] * (3 * nodes[i].x() - 2 * nodes[i].y()) * Vec2(m.gx[k], m.gy[k]);
    EXPECT_NEAR((gradient - Vec2(3, -2)).norm(), 0, 1e-13);
  }
}

TEST(Quadrature, gauss_rule_with_n_points_is_exact_to_degree_2n_minus_1_and_no_further) {
  for (int n = 1; n <= 8; ++n) {
    for (int degree = 0; degree <= 2 * n; ++degree) {
      double sum = 0;
      for (const LinePoint& p : gauss_legendre(n)) sum += p.weight * std::pow(p.s, degree);
      const double error = std::abs(sum - 1.0 / (degree + 1));
      if (degree < 2 * n)
        EXPECT_LT(error, 1e-15) << n << ' ' << degree;
      else
        EXPECT_GT(error, 1e-12) << n << ' ' << degree;
    }
  }
}

TEST(Element, shape_functions_are_one_at_their_node_and_zero_at_the_others) {
  const std::array<std::array<double, 3>, 6> nodes{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}}};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) EXPECT_DOUBLE_EQ(p2_at(nodes[i])[j], i == j ? 1 : 0);
}

TEST(Element, gradients_are_exact_for_every_quadratic) {
  const Triangle t({Vec2(0.1, -0.2), Vec2(1.3, 0.4), Vec2(0.3, 0.9)});
  const auto f = [](const Vec2& x) {
    return 1 + 2 * x.x() - x.y() + 3 * x.x() * x.y() - x.x() * x.x() + x.y() * x.y();
  };
  const auto gradient = [](const Vec2& x) {
    return Vec2(2 + 3 * x.y() - 2 * x.x(), -1 + 3 * x.x() + 2 * x.y());
  };
  Padded values = Padded::Zero();
  for (int i = 0; i < 3; ++i) {
    values[i] = f(t.corner[i]);
    values[3 + i] = f(0.5 * (t.corner[i] + t.corner[(i + 1) % 3]));
  }
  const Vec2 x(0.5, 0.3);
  const Shape shape = shape_at(t.barycentric(x));
  Vec2 found = Vec2::Zero();
  for (int k = 0; k < 3; ++k) found += shape.dn[k].dot(values) * t.gradient[k];
  EXPECT_NEAR(shape.n.dot(values), f(x), 1e-14);
  EXPECT_NEAR((found - gradient(x)).norm(), 0, 1e-13);
}

}  // namespace
}  // namespace fpi::fluid
