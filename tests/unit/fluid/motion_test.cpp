/// How nodes go with bodies, and what they take along.
#include "fluid/solve/motion.hpp"

#include <gtest/gtest.h>

#include "fluid/solve/history.hpp"
#include "stress/fluid_case.hpp"

namespace fpi::fluid::testing {
namespace {

std::map<std::string, scene::Boundary> walls() {
  return {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", no_slip()}};
}

Interface bar(const Vec2& centre, double angle) {
  Interface f;
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  set_edges(f, {centre - 0.2 * along - 0.05 * across, centre + 0.2 * along - 0.05 * across,
                centre + 0.2 * along + 0.05 * across, centre - 0.2 * along + 0.05 * across});
  f.rigid.centre = centre;
  return f;
}

/// Of a node near x.
Vec2 at(const Space& space, const Vector& displacement, const Vec2& x) {
  Index nearest = 0;
  for (Index n = 0; n < space.mesh.n_nodes(); ++n)
    if ((space.mesh.node_position(n) - x).norm() < (space.mesh.node_position(nearest) - x).norm())
      nearest = n;
  return displacement.segment<2>(2 * nearest);
}

TEST(Motion, nodes_on_a_body_go_all_the_way_and_those_far_away_or_on_the_boundary_stay) {
  const Space space(square(20), walls());
  const Interface before = circle(3, {0.5, 0.5}, 0.1, 0.05), after = circle(3, {0.53, 0.49}, 0.1, 0.05);
  const std::vector<BodyPlace> places{place_of(before)};
  const Vector d = displacement(space, {&after, 1}, places, 0.1);
  EXPECT_LT((at(space, d, {0.55, 0.5}) - Vec2(0.03, -0.01)).norm(), 1e-15);
  EXPECT_EQ(at(space, d, {0.9, 0.9}), Vec2(0, 0));
  const double between = at(space, d, {0.75, 0.5}).x();
  EXPECT_GT(between, 0);
  EXPECT_LT(between, 0.03);
  for (const BoundaryEdge& b : space.mesh.boundary)
    for (const Index node : space.mesh.edge_nodes(b.edge)) EXPECT_TRUE(d.segment<2>(2 * node).isZero(0));
}

TEST(Motion, a_body_without_a_place_before_comes_from_where_its_velocity_puts_it) {
  const Space space(square(20), walls());
  Interface body = circle(3, {0.5, 0.5}, 0.1, 0.05);
  body.rigid.translation = {2, -1};
  EXPECT_LT((at(space, displacement(space, {&body, 1}, {}, 0.01), {0.5, 0.5}) - Vec2(0.02, -0.01)).norm(),
            1e-15);
}

TEST(Motion, a_polygon_takes_nodes_along_its_turn_and_a_disc_does_not) {
  const Space space(square(20), walls());
  const std::vector<BodyPlace> places{place_of(bar({0.5, 0.5}, 3.1))};
  const Interface turned = bar({0.5, 0.5}, 3.2);  // the angle jumps from π to −π on the way
  const Vec2 x(0.6, 0.5), arm = x - Vec2(0.5, 0.5);
  const Vec2 from(std::cos(0.1) * arm.x() + std::sin(0.1) * arm.y(),
                  std::cos(0.1) * arm.y() - std::sin(0.1) * arm.x());
  EXPECT_LT((at(space, displacement(space, {&turned, 1}, places, 1), x) - (arm - from)).norm(), 1e-14);
  Interface disc = circle(3, {0.5, 0.5}, 0.1, 0.05);
  disc.rigid.spin = 7;
  EXPECT_TRUE(displacement(space, {&disc, 1}, {}, 0.1).isZero(0));
}

TEST(Motion, each_of_two_bodies_that_nearly_touch_takes_its_own_surface_along) {
  const Space space(square(40), walls());
  const std::vector<Interface> bodies{circle(1, {0.4, 0.5}, 0.1, 0.02), circle(2, {0.61, 0.5}, 0.1, 0.02)};
  const std::vector<BodyPlace> places{place_of(circle(1, {0.39, 0.5}, 0.1, 0.02)),
                                      place_of(circle(2, {0.62, 0.5}, 0.1, 0.02))};
  const Vector d = displacement(space, bodies, places, 0.1);
  EXPECT_LT((at(space, d, {0.475, 0.5}) - Vec2(0.01, 0)).norm(), 1e-15);
  EXPECT_LT((at(space, d, {0.525, 0.5}) - Vec2(-0.01, 0)).norm(), 1e-15);
}

TEST(Motion, an_image_across_a_periodic_side_takes_nodes_along_too) {
  const Space space(make_rectangle(uniform_lines(0, 1, 20), uniform_lines(0, 1, 20), {}, {true, false}),
                    {{"bottom", no_slip()}, {"top", no_slip()}});
  const Interface after = circle(3, {0.99, 0.5}, 0.1, 0.05), before = circle(3, {0.97, 0.5}, 0.1, 0.05);
  const std::vector<BodyPlace> places{place_of(before)};
  EXPECT_LT((at(space, displacement(space, {&after, 1}, places, 0.1), {0.05, 0.5}) - Vec2(0.02, 0)).norm(),
            1e-15);
}

/// A field that is quadratic in space is carried exactly; in a cell whose nodes all move alike its history is
/// too.
TEST(History, a_quadratic_field_is_found_at_the_places_that_nodes_came_from) {
  const Space space(square(20), walls());
  const Interface after = circle(3, {0.53, 0.49}, 0.1, 0.05);
  const std::vector<BodyPlace> places{place_of(circle(3, {0.5, 0.5}, 0.1, 0.05))};
  const Vector d = displacement(space, {&after, 1}, places, 0.1);
  State state = State::at_rest(space.mesh.n_nodes(), space.mesh.n_vertices());
  const auto field = [](const Vec2& x) { return Vec2(x.x() * x.y(), 1 - x.y() * x.y()); };
  for (Index n = 0; n < space.mesh.n_nodes(); ++n)
    state.u.segment<2>(2 * n) = field(space.mesh.node_position(n));
  const State old = along_paths(space, d, state);
  for (Index n = 0; n < space.mesh.n_nodes(); ++n)
    EXPECT_LT((old.u.segment<2>(2 * n) - field(space.mesh.node_position(n) - d.segment<2>(2 * n))).norm(),
              1e-13);
}

TEST(Scheme, bdf2_differentiates_a_parabola_exactly_for_unequal_steps) {
  const double dt = 0.3, before = 0.2;
  const auto f = [](double t) { return 1 + 2 * t - 5 * t * t; };
  const Scheme s = Scheme::bdf2(dt, before);
  const double found = s.inertia * (f(dt) - f(0)) - s.before * (f(0) - f(-before));
  EXPECT_NEAR(found, 2 - 10 * dt, 1e-14);
}

}  // namespace
}  // namespace fpi::fluid::testing
