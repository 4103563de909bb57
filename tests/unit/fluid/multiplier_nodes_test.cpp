#include "fluid/cut/multiplier_nodes.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

namespace fpi::fluid {
namespace {

constexpr double pi = std::numbers::pi;

Interface circle(int n_arcs, double turn = 0) {
  Interface out;
  out.surface = Disc{{0, 0}, 1};
  for (int a = 0; a < n_arcs; ++a) {
    out.start.push_back(turn + 2 * pi * a / n_arcs);
    out.end.push_back(turn + 2 * pi * (a + 1) / n_arcs);
  }
  return out;
}

/// 4 by 1, its edges 0.5 long, the first one in the middle of a side.
Interface box() {
  std::vector<Vec2> vertices;
  for (double x = 1; x < 4; x += 0.5) vertices.emplace_back(x, 0);
  for (double y = 0; y < 1; y += 0.5) vertices.emplace_back(4, y);
  for (double x = 4; x > 0; x -= 0.5) vertices.emplace_back(x, 1);
  for (double y = 1; y > 0; y -= 0.5) vertices.emplace_back(0, y);
  for (double x = 0; x < 1; x += 0.5) vertices.emplace_back(x, 0);
  Interface out;
  set_edges(out, vertices);
  return out;
}

double at(const MultiplierNodes& multiplier_nodes, const std::vector<double>& values, Index arc,
          double parameter) {
  const auto [left, right] = multiplier_nodes.values(arc);
  const auto hats = multiplier_nodes.hats(arc, parameter);
  return hats[0] * values[left] + hats[1] * values[right];
}

std::vector<double> some_values(const MultiplierNodes& multiplier_nodes) {
  std::vector<double> values;
  for (Index k = 0; k < multiplier_nodes.size(); ++k) values.push_back(std::cos(7.0 * k));
  return values;
}

double sum(const std::vector<double>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

TEST(MultiplierNodes, every_end_of_an_arc_is_one_where_arcs_are_as_long_as_elements) {
  const Interface interface = circle(20);
  EXPECT_EQ(MultiplierNodes(interface, [](const Vec2&) { return 2 * pi / 20; }).size(), 20);
  EXPECT_EQ(MultiplierNodes(interface, [](const Vec2&) { return 0.0; }).size(), 20);
}

TEST(MultiplierNodes, the_multiplier_is_continuous_around_a_circle_and_its_functions_add_up_to_its_length) {
  for (const double size : {0.1, 0.31, 0.7, 2.0}) {
    const Interface interface = circle(23, 1.3);
    const MultiplierNodes multiplier_nodes(interface, [=](const Vec2&) { return size; });
    const auto values = some_values(multiplier_nodes);
    EXPECT_GE(2 * pi / multiplier_nodes.size(), 0.8 * size);
    EXPECT_NEAR(sum(multiplier_nodes.lengths()), 2 * pi, 1e-12);
    for (Index a = 0; a < 23; ++a) {
      const Index next = (a + 1) % 23;
      EXPECT_NEAR(at(multiplier_nodes, values, a, interface.end[a]),
                  at(multiplier_nodes, values, next, interface.start[next]), 1e-12)
          << size << ", arc " << a;
    }
  }
}

TEST(MultiplierNodes, are_further_apart_where_elements_are_larger) {
  const Interface interface = circle(40);
  const MultiplierNodes multiplier_nodes(interface,
                                         [](const Vec2& x) { return x.x() > 0 ? 2 * pi / 40 : 2 * pi / 20; });
  EXPECT_NEAR(multiplier_nodes.size(), 30, 1);
}

TEST(MultiplierNodes, a_circle_smaller_than_an_element_has_one_value) {
  const MultiplierNodes multiplier_nodes(circle(4), [](const Vec2&) { return 10.0; });
  ASSERT_EQ(multiplier_nodes.size(), 1);
  EXPECT_NEAR(multiplier_nodes.lengths()[0], 2 * pi, 1e-12);
  EXPECT_EQ(at(multiplier_nodes, {3}, 2, pi), 3);
}

TEST(MultiplierNodes, a_polygon_has_values_of_its_own_on_every_side_and_constants_beside_its_corners) {
  const Interface interface = box();
  const MultiplierNodes multiplier_nodes(interface, [](const Vec2&) { return 0.5; });
  EXPECT_EQ(multiplier_nodes.size(), 7 + 1 + 7 + 1);
  EXPECT_NEAR(sum(multiplier_nodes.lengths()), 10, 1e-12);
  const auto values = some_values(multiplier_nodes);
  for (Index a = 0; a < interface.n_arcs(); ++a) {
    const Index next = (a + 1) % interface.n_arcs();
    const double end = at(multiplier_nodes, values, a, interface.end[a]);
    const double start = at(multiplier_nodes, values, next, interface.start[next]);
    if (interface.surface.is_corner(interface.end[a])) {
      EXPECT_EQ(multiplier_nodes.values(a)[0], multiplier_nodes.values(a)[1]);
      EXPECT_NE(end, start);
    } else {
      EXPECT_NEAR(end, start, 1e-12) << "edge " << a;
    }
  }
}

}  // namespace
}  // namespace fpi::fluid
