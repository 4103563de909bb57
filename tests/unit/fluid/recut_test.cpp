/// A cut mesh made from the one before is the one that would be made from nothing, and only what is near the
/// bodies that moved is cut anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cut_case.hpp"
#include "fluid/cut/components.hpp"

namespace fpi::fluid {
namespace {

struct Case {
  Mesh mesh;
  Locator locator{mesh};
  std::mt19937 random{11};

  explicit Case(const std::array<bool, 2>& periodic)
      : mesh(make_rectangle(uniform_lines(-1, 1, 24), uniform_lines(-1, 1, 24), {}, periodic)) {}
  double number(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random);
  }
  Vec2 place() { return {number(-1, 1), number(-1, 1)}; }

  /// As a step does it, pockets between overlapping bodies left out.
  CutMesh cut(const std::vector<Interface>& bodies, const CutMesh& before) const {
    CutMesh out = cut_mesh(mesh, locator, bodies, before);
    Components parts = find_components(mesh, out);
    drop_pockets(mesh, bodies, parts, out);
    return out;
  }
};

Interface triangle(const Vec2& centre, double angle) {
  std::vector<Vec2> corners;
  for (int k = 0; k < 3; ++k) corners.push_back(Disc{centre, 0.2}.at(angle + 2 * pi * k / 3));
  Interface out;
  out.rigid.centre = centre;
  set_edges(out, corners);
  return out;
}

/// Discs, some smaller than an element, and triangles, where they fall: over each other and over the sides.
std::vector<Interface> scattered(Case& c, int n) {
  std::vector<Interface> bodies;
  for (int k = 0; k < n; ++k)
    bodies.push_back(k % 4 == 3 ? triangle(c.place(), c.number(0, 6))
                                : circle(c.place(), k % 4 == 0 ? 0.03 : c.number(0.05, 0.25), 16));
  return bodies;
}

void expect_same(const CutMesh& a, const CutMesh& b) {
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.first_multiplier, b.first_multiplier);
  EXPECT_EQ(a.active_length, b.active_length);
  EXPECT_TRUE(std::ranges::equal(a.cut_cells, b.cut_cells, [](const auto& x, const auto& y) {
    const auto same = [](const ElementPoint& p, const ElementPoint& q) {
      return p.shape.l == q.shape.l && p.shape.n == q.shape.n && p.weight == q.weight;
    };
    return x->cell == y->cell && x->share == y->share && std::ranges::equal(x->points, y->points, same);
  }));
  EXPECT_TRUE(std::ranges::equal(a.pieces, b.pieces, [](const ArcPiece& x, const ArcPiece& y) {
    return x.cell == y.cell && x.interface == y.interface && x.arc == y.arc &&
           x.multipliers == y.multipliers && x.start == y.start && x.end == y.end && x.shift == y.shift;
  }));
  EXPECT_TRUE(std::ranges::equal(a.ghost_faces, b.ghost_faces, [](const auto& x, const auto& y) {
    return x->edge == y->edge && x->nodes == y->nodes && x->vertices == y->vertices &&
           x->velocity == y->velocity && x->pressure == y->pressure && x->h2 == y->h2;
  }));
  EXPECT_TRUE(std::ranges::equal(a.covered, b.covered, [](const CoveredNode& x, const CoveredNode& y) {
    return x.node == y.node && x.interface == y.interface && x.shift == y.shift;
  }));
}

TEST(Recut, is_bitwise_what_a_cut_from_nothing_is) {
  for (const std::array<bool, 2> periodic : {std::array{false, false}, {true, false}, {true, true}}) {
    Case c(periodic);
    std::vector<Interface> bodies = scattered(c, 12);
    CutMesh cut;
    for (int step = 0; step < 60; ++step) {
      cut = c.cut(bodies, cut);
      expect_same(cut, c.cut(bodies, {}));
      for (std::size_t k = 0; k < bodies.size(); ++k)
        if (c.number(0, 1) < 0.3) bodies[k] = scattered(c, static_cast<int>(k) + 1).back();
      if (step % 20 == 19) std::swap(bodies.front(), bodies.back());
    }
  }
}

TEST(Recut, cuts_only_cells_that_a_moved_body_meets_or_met) {
  Case c({true, true});
  std::vector<Interface> bodies;
  for (int k = 0; k < 9; ++k)
    bodies.push_back(circle({-0.66 + 0.66 * (k % 3), -0.66 + 0.66 * (k / 3)}, 0.3, 20));
  const CutMesh before = c.cut(bodies, {});
  bodies[2] = circle(bodies[2].rigid.centre + Vec2(0.07, 0.02), 0.3, 20);  // it straddles a side
  const CutMesh after = c.cut(bodies, before);

  const auto meets_moved = [](const CutMesh& cut, Index cell) {
    return std::ranges::any_of(cut.images, [&](const Image& image) {
      return image.interface == 2 && std::ranges::binary_search(image.intersected_cells->cut, cell);
    });
  };
  std::size_t anew = 0, new_faces = 0;
  for (const auto& cell : after.cut_cells) {
    if (std::ranges::find(before.cut_cells, cell) != before.cut_cells.end()) continue;
    EXPECT_TRUE(meets_moved(before, cell->cell) || meets_moved(after, cell->cell)) << cell->cell;
    ++anew;
  }
  for (const auto& face : after.ghost_faces)
    new_faces += std::ranges::find(before.ghost_faces, face) == before.ghost_faces.end();
  EXPECT_GT(anew, 0u);
  EXPECT_LT(anew, after.cut_cells.size() / 7);
  EXPECT_GT(new_faces, 0u);
  EXPECT_LT(new_faces, after.ghost_faces.size() / 7);
}

}  // namespace
}  // namespace fpi::fluid
