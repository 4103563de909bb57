#include "fluid/cut/cut.hpp"

#include <gtest/gtest.h>

#include <random>

#include "cut_case.hpp"

namespace fpi::fluid {
namespace {

TEST(Cut, area_and_moments_outside_a_disc_are_exact_to_1e9_wherever_it_lies) {
  const Square square(16);  // D/h = 8
  std::mt19937 random(1);
  std::uniform_real_distribution<double> offset(-0.15, 0.15);
  for (int sample = 0; sample < 200; ++sample) {
    const Vec2 c(offset(random), offset(random));
    const double r = 0.5;
    const std::vector<Interface> bodies{circle(c, r, 24)};
    const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
    const double area = pi * r * r;
    EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - area, 1e-9);
    EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2& x) { return x.x(); }), -area * c.x(), 1e-9);
    EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2& x) { return x.y() * x.y(); }),
                4.0 / 3 - area * (c.y() * c.y() + r * r / 4), 1e-9);
    EXPECT_NEAR(arc_length(cut), 2 * pi * r, 1e-12);
  }
}

TEST(Cut, degenerate_positions_keep_area_and_arc_length) {
  const Square square(16);
  const double h = 2.0 / 16;
  struct Case {
    Vec2 centre;
    double radius;
  };
  const std::vector<Case> cases{
      {{0, 0}, 0.5},              // centre on a node, circle through vertices
      {{0, 0}, 4 * h},            // the same, by the grid
      {{h / 2, h / 2}, 3.5 * h},  // tangent to grid lines
      {{0.01, 0.02}, 0.02},       // within one element
      {{0.013, 0.03}, 1e-6},      // far smaller than an element
      {{h / 3, h / 5}, h / 2},    // of an element's size
      {{h, h}, h * std::sqrt(2.0)},
      {{0, 0}, h},
      {{1e-12, -1e-12}, 0.5},
  };
  for (const Case& c : cases) {
    const std::vector<Interface> bodies{circle(c.centre, c.radius, 12)};
    const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
    EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - pi * c.radius * c.radius,
                1e-6 * h)
        << c.centre.transpose() << " r " << c.radius;
    // Where a circle only grazes an edge, the crossing is known to the root of round-off.
    EXPECT_NEAR(arc_length(cut), 2 * pi * c.radius, 1e-7 * c.radius)
        << c.centre.transpose() << " r " << c.radius;
  }
}

TEST(Cut, two_discs_in_one_element_and_touching_leave_the_rest) {
  const Square square(10);
  for (const double gap : {0.1, 0.01, 1e-4, 0.0}) {
    const double r = 0.31;
    const std::vector<Interface> bodies{circle({-r - gap / 2, 0.03}, r, 10),
                                        circle({r + gap / 2, 0.03}, r, 10)};
    const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
    EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - 2 * pi * r * r, 1e-6)
        << gap;
    EXPECT_NEAR(arc_length(cut), 4 * pi * r, 1e-11) << gap;
  }
}

TEST(Cut, arcs_inside_another_body_are_left_out) {
  const Square square(16);
  const double r = 0.3, d = 0.4;  // distance of the centres: they overlap
  const std::vector<Interface> bodies{circle({-d / 2, 0}, r, 16), circle({d / 2, 0}, r, 16)};
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  const double half = std::acos(d / (2 * r));
  const double lens = 2 * r * r * half - d * std::sqrt(r * r - d * d / 4);
  EXPECT_NEAR(arc_length(cut), 2 * r * (2 * pi - 2 * half), 1e-11);
  EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - (2 * pi * r * r - lens),
              1e-6);
}

TEST(Cut, elements_inside_a_body_are_deactivated) {
  const Square square(16);
  const std::vector<Interface> bodies{circle({0.01, 0.02}, 0.5, 24)};
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  for (Index c = 0; c < square.mesh.n_cells(); ++c)
    EXPECT_EQ(cut.state[c] == CellState::solid,
              position(square.mesh.corners(c), bodies[0].surface) == Position::inside);
}

TEST(Cut, pieces_of_an_arc_add_up_to_it) {
  const Square square(16);
  const std::vector<Interface> bodies{circle({0.03, 0.05}, 0.45, 23)};
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  for (double length : cut.active_length) EXPECT_NEAR(length, 2 * pi * 0.45 / 23, 1e-13);
}

}  // namespace
}  // namespace fpi::fluid
