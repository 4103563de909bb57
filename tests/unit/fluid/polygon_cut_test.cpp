/// Polygons cut the mesh exactly: areas, moments and perimeters, wherever they lie.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "core/error.hpp"
#include "cut_case.hpp"

namespace fpi::fluid {
namespace {

using Shape = std::vector<Vec2>;
const Shape square_shape{{-0.4, -0.4}, {0.4, -0.4}, {0.4, 0.4}, {-0.4, 0.4}};
const Shape blade{{-0.5, -0.004}, {0.5, -0.004}, {0.5, 0.004}, {-0.5, 0.004}};
const Shape ell{{0, 0}, {0.6, 0}, {0.6, 0.2}, {0.2, 0.2}, {0.2, 0.5}, {0, 0.5}};

Shape moved(const Shape& shape, const Vec2& to, double angle) {
  const Eigen::Rotation2Dd turn(angle);
  Shape out;
  for (const Vec2& x : shape) out.push_back(to + turn * x);
  return out;
}

/// The sides cut into edges near 0.1 long.
Interface outline_of(const Shape& shape) {
  Shape vertices;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const Vec2 &a = shape[k], &b = shape[(k + 1) % shape.size()];
    const int n = std::max(1, static_cast<int>(std::lround((b - a).norm() / 0.1)));
    for (int e = 0; e < n; ++e) vertices.push_back(a + (b - a) * (static_cast<double>(e) / n));
  }
  Interface out;
  set_edges(out, vertices);
  return out;
}

double perimeter(const Shape& shape) {
  double sum = 0;
  for (std::size_t k = 0; k < shape.size(); ++k) sum += (shape[(k + 1) % shape.size()] - shape[k]).norm();
  return sum;
}

/// ∫ (y − y_c)² over the inside, by triangles from the origin.
double second_moment(const Shape& shape) {
  double sum = 0;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const Vec2 &a = shape[k], &b = shape[(k + 1) % shape.size()];
    sum += cross(a, b) / 12 * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y());
  }
  return sum;
}

void expect_exact(const Square& square, const Shape& shape, const std::string& what) {
  const std::vector<Interface> bodies{outline_of(shape)};
  const Surface& surface = bodies[0].surface;
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  const double area = surface.area();
  EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - area, 1e-12) << what;
  EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2& x) { return x.x(); }),
              -area * surface.centroid().x(), 1e-12)
      << what;
  EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2& x) { return x.y() * x.y(); }),
              4.0 / 3 - second_moment(shape), 1e-12)
      << what;
  EXPECT_NEAR(arc_length(cut), perimeter(shape), 1e-12) << what;
  const auto& lengths = cut.multiplier_nodes[0].lengths();
  for (Index a = 0; a < cut.n_multipliers(); ++a)
    EXPECT_NEAR(cut.active_length[a], lengths[a], 1e-12) << what << ", multiplier " << a;
}

TEST(PolygonCut, areas_moments_and_edges_are_exact_wherever_and_however_turned) {
  const Square square(16);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-0.2, 0.2), angle(0, 2 * pi);
  for (int sample = 0; sample < 200; ++sample) {
    const Vec2 to(offset(random), offset(random));
    const double turn = angle(random);
    const std::string what = fmt::format("sample {}", sample);
    expect_exact(square, moved(square_shape, to, turn), what + ", square");
    expect_exact(square, moved(blade, to, turn), what + ", blade");
    expect_exact(square, moved(ell, to, turn), what + ", L");
  }
}

TEST(PolygonCut, sides_and_corners_on_mesh_edges_and_nodes_are_exact) {
  const Square square(16);
  const double h = 2.0 / 16;
  const Shape unit{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const auto scaled = [](Shape s, double factor) {
    for (Vec2& x : s) x *= factor;
    return s;
  };
  expect_exact(square, scaled(unit, 3 * h), "sides along mesh lines, corners on nodes");
  expect_exact(square, moved(scaled(unit, 3 * h), {h / 2, h / 4}, 0), "sides beside mesh lines");
  expect_exact(square, moved(scaled(unit, 2.5 * h), {h / 2, h / 2}, 0), "another way on mesh lines");
  expect_exact(square, moved(scaled(unit, 2 * h), {h / 2, 0}, 0), "corners within mesh edges");
  expect_exact(square, moved(scaled(unit, 3 * h), {0, 0}, pi / 4), "sides along diagonals");
  expect_exact(square, moved(scaled(unit, 2 * h * std::sqrt(2.0)), {0, 0}, pi / 4),
               "the same, from node to node");
  expect_exact(square, moved(ell, {0, 0}, pi / 2), "an L along mesh lines");
  expect_exact(square, moved(scaled(unit, 0.01 * h), {0.3 * h, 0.2 * h}, 0.3), "within one element");
  expect_exact(square, moved(scaled(unit, 0.01 * h), {h, h}, 0.3), "around a node");
  for (const double shift : {1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6})
    for (const double sign : {-1.0, 1.0}) {
      const Vec2 by(sign * shift, -sign * shift);
      expect_exact(square, moved(scaled(unit, 3 * h), by, 0),
                   fmt::format("mesh lines but for {}", sign * shift));
      expect_exact(square, moved(scaled(unit, 3 * h), {0, 0}, sign * shift),
                   fmt::format("turned by {}", shift));
    }
}

TEST(PolygonCut, a_side_along_mesh_edges_belongs_to_the_fluid_beside_it) {
  const Square square(8);
  const std::vector<Interface> bodies{
      outline_of(moved({{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, {0, 0}, 0))};
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  for (const ArcPiece& piece : cut.pieces) {
    const auto c = square.mesh.corners(piece.cell);
    EXPECT_FALSE(bodies[0].surface.contains((c[0] + c[1] + c[2]) / 3));
  }
  for (Index c = 0; c < square.mesh.n_cells(); ++c) {
    const auto k = square.mesh.corners(c);
    EXPECT_EQ(cut.state[c] == CellState::solid, bodies[0].surface.contains((k[0] + k[1] + k[2]) / 3));
  }
}

TEST(PolygonCut, what_sticks_out_of_the_mesh_carries_no_edges) {
  const Square square(10);
  const std::vector<Interface> bodies{outline_of({{0, -1.2}, {1.3, -1.2}, {1.3, -0.43}, {0, -0.43}})};
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - 0.57, 1e-12);
  EXPECT_NEAR(arc_length(cut), 1 + 0.57, 1e-12);
}

TEST(PolygonCut, discs_and_polygons_share_elements) {
  const Square square(10);
  // A disc of radius 0.3 about the corner of an L: a quarter or three quarters of it lie in the L.
  const Interface l = outline_of({{0, 0}, {0.7, 0}, {0.7, 0.31}, {0, 0.31}});
  const std::vector<Interface> bodies{l, circle({0, 0}, 0.3, 20)};
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - 0.7 * 0.31 - 0.75 * pi * 0.09,
              1e-8);
  EXPECT_NEAR(arc_length(cut), 2 * (0.7 + 0.31) - 0.6 + 0.75 * 2 * pi * 0.3, 1e-10);
}

TEST(PolygonCut, polygons_that_share_a_side_leave_no_edge_between_them) {
  const Square square(10);
  const std::vector<Interface> bodies{outline_of({{-0.35, -0.2}, {0.05, -0.2}, {0.05, 0.2}, {-0.35, 0.2}}),
                                      outline_of({{0.05, -0.2}, {0.5, -0.2}, {0.5, 0.2}, {0.05, 0.2}})};
  const CutMesh cut = cut_mesh(square.mesh, square.locator, bodies);
  EXPECT_NEAR(integrate(square.mesh, cut, [](const Vec2&) { return 1.0; }), 4 - 0.85 * 0.4, 1e-12);
  EXPECT_NEAR(arc_length(cut), 2 * (0.85 + 0.4), 1e-8);
}

TEST(PolygonCut, vertices_within_sides_are_not_corners) {
  const Interface surface = outline_of(moved(ell, {0.1, -0.3}, 0.7));
  EXPECT_EQ(surface.surface.polygon()->size(), 6);
  EXPECT_EQ(surface.n_arcs(), 22);
  Shape turned = moved(square_shape, {0, 0}, 0);
  turned.insert(turned.begin(), {{-0.4, 0.1}, {-0.4, -0.1}});  // start within the last side
  Interface late;
  set_edges(late, turned);
  EXPECT_EQ(late.surface.polygon()->size(), 4);
  for (Index a = 0; a < late.n_arcs(); ++a)
    EXPECT_LT((late.surface.at(late.start[a]) - turned[a]).norm(), 1e-15);
  EXPECT_NO_THROW(check(std::vector<Interface>{late}));
}

TEST(PolygonCut, an_outline_the_wrong_way_round_or_without_corners_is_refused) {
  Shape clockwise = square_shape;
  std::reverse(clockwise.begin(), clockwise.end());
  EXPECT_THROW(check(std::vector<Interface>{outline_of(clockwise)}), Error);
  EXPECT_THROW(outline_of({{0, 0}, {1, 0}, {2, 0}}), Error);
}

TEST(Uncovered, is_what_bodies_leave_of_a_segment) {
  const std::vector<Surface> bodies{Disc{{0, 0}, 0.5}, Polygon{{{0.4, -1}, {2, -1}, {2, 1}, {0.4, 1}}}};
  EXPECT_TRUE(uncovered({-0.4, 0}, {1.9, 0.1}, bodies).empty());
  EXPECT_EQ(uncovered({5, 5}, {6, 6}, bodies).size(), 1u);
  const auto left = uncovered({-1, 0}, {3, 0}, bodies);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_NEAR(left[0].start, 0, 0);
  EXPECT_NEAR(left[0].end, 0.125, 1e-15);
  EXPECT_NEAR(left[1].start, 0.75, 1e-15);
  EXPECT_NEAR(left[1].end, 1, 0);
}

TEST(Polygons, what_lies_on_a_side_counts_as_covered_whichever_side_it_is) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    const auto turned = [&](Vec2 x) {
      for (int k = 0; k < quarter; ++k) x = Vec2(-x.y(), x.x());
      return x;
    };
    Interface body;
    set_edges(body, {turned({0.4, 0}), turned({1, 0}), turned({1, 0.5}), turned({0.4, 0.5})});
    const std::vector<Surface> bodies{body.surface};
    for (const bool forwards : {true, false}) {
      const Vec2 a = turned({1, 0.3}), b = turned({1, 0.7});
      const auto left = forwards ? uncovered(a, b, bodies) : uncovered(b, a, bodies);
      ASSERT_EQ(left.size(), 1u) << quarter;
      EXPECT_NEAR(left[0].start, forwards ? 0.5 : 0, 1e-12);
      EXPECT_NEAR(left[0].end, forwards ? 1 : 0.5, 1e-12);
      EXPECT_TRUE(uncovered(turned({1, 0.1}), turned({1, 0.4}), bodies).empty()) << quarter;
    }
  }
}

TEST(Polygons, an_outline_from_outside_that_is_none_is_refused_with_the_body) {
  Interface body;
  body.body = 7;
  for (const std::vector<Vec2>& vertices : {std::vector<Vec2>{{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}},
                                            {{0, 0}, {1, 1}, {1, 0}, {0, 1}},
                                            {{0, 0}, {1, 0}},
                                            {{0, 0}, {1, 0}, {1 + 1e-15, 1e-15}, {1, 1}}}) {
    try {
      set_edges(body, vertices);
      FAIL();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("body 7: "), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace fpi::fluid
