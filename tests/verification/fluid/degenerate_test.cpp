/// Cuts that have no general position: through vertices, along and tangent to edges, smaller than an element,
/// over sides of the domain. Each is solved as right as its neighbours, or refused with a sentence.
#include <gtest/gtest.h>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;

constexpr double h = 0.1;

/// Stokes flow through a channel 2 m high and 4 m long, U = 1 m/s at its axis, μ = 1 Pa s.
struct Channel {
  NavierStokes solver;

  static Settings stokes(const scene::Boundary& right) {
    auto s = settings(
        1, 1,
        {{"left", velocity("1-y^2", "0")}, {"right", right}, {"bottom", no_slip()}, {"top", no_slip()}});
    s.fluid.convection = false;
    return s;
  }
  explicit Channel(const scene::Boundary& right = open())
      : solver(make_rectangle(uniform_lines(-2, 2, 40), uniform_lines(-1, 1, 20)), stokes(right)) {}

  std::vector<BodyTraction> solve(const std::vector<Disc>& discs) {
    std::vector<Interface> bodies;
    for (const Disc& disc : discs)
      bodies.push_back(
          circle(static_cast<Index>(bodies.size()), disc.centre, disc.radius, solver.arc_length(disc)));
    const Result result = solve_steady(solver, bodies);
    EXPECT_TRUE(result.newton.converged) << result.newton.reason;
    return result.tractions;
  }
  double drag(const Disc& disc) { return solve({disc}).at(0).force.x(); }

  /// ∫u dy over what bodies leave of x [m²/s], by the midpoint rule.
  double flux(double x) const {
    constexpr int n = 4000;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      if (const auto at = solver.at({x, -1 + 2 * (i + 0.5) / n})) sum += at->first.x() * 2 / n;
    return sum;
  }
};

/// What a refusal says; empty where there is none.
template <class F>
std::string refusal(F f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Degenerate, a_circle_through_nodes_around_a_node_is_as_good_as_one_beside) {
  Channel channel;
  const double aligned = channel.drag({{0, 0}, 5 * h});  // through (3, 4) h, tangent to lines at (0, 5) h
  for (const double shift : {1e-14, 1e-9, 1e-5, 0.3, 0.5})
    EXPECT_NEAR(channel.drag({{shift * h, 0}, 5 * h}) / aligned, 1, 1e-4) << shift;
}

TEST(Degenerate, a_circle_that_is_tangent_to_edges_is_as_good_as_one_that_just_misses_them) {
  Channel channel;
  const Vec2 centre(0.5 * h, 0.5 * h);
  const double tangent = channel.drag({centre, 4.5 * h});
  for (const double shift : {-1e-9, -1e-13, 1e-13, 1e-9})
    EXPECT_NEAR(channel.drag({centre, (4.5 + shift) * h}) / tangent, 1, 1e-5) << shift;
}

/// The element's one polynomial cannot follow the logarithm around a body much smaller than a fifth of it.
TEST(Degenerate, a_body_smaller_than_an_element_has_about_its_drag_wherever_it_is) {
  Channel channel;
  // Faxén's series for a cylinder on the axis between walls 2 m apart, in a parabola.
  const auto exact = [](double d) { return 4 * std::numbers::pi / (std::log(2 / d) - 0.9157); };
  for (const Vec2& centre : {Vec2(0, 0), Vec2(0.5 * h, 0), Vec2(0.3 * h, 0.6 * h)}) {
    for (const double d : {0.5 * h, 0.2 * h})
      EXPECT_NEAR(channel.drag({centre, 0.5 * d}) / exact(d), 1, 0.4) << d << " at " << centre.transpose();
    const double tiny = channel.drag({centre, 0.01 * h});
    EXPECT_GT(tiny, 0.6 * exact(0.02 * h)) << centre.transpose();
    EXPECT_LT(tiny, 1.4 * exact(0.2 * h)) << centre.transpose();
  }
}

TEST(Degenerate, several_bodies_inside_one_element_share_the_drag_of_one) {
  Channel channel;
  const double one = channel.drag({{0.3 * h, 0.7 * h}, 0.12 * h});
  const auto two = channel.solve({{{0.2 * h, 0.75 * h}, 0.12 * h}, {{0.45 * h, 0.8 * h}, 0.1 * h}});
  const auto three = channel.solve(
      {{{0.2 * h, 0.55 * h}, 0.12 * h}, {{0.45 * h, 0.7 * h}, 0.1 * h}, {{0.2 * h, 0.85 * h}, 0.09 * h}});
  for (const auto& several : {two, three}) {
    double sum = 0;
    for (const BodyTraction& t : several) sum += t.force.x();
    EXPECT_GT(sum, 0.9 * one);
    EXPECT_LT(sum, 1.6 * one);
  }
}

TEST(Degenerate, a_body_that_cuts_a_wall_lets_all_the_fluid_past_it_and_has_one_force_wherever_the_mesh_is) {
  Channel channel;
  const double drag = channel.drag({{0, -1}, 0.5});
  EXPECT_NEAR(channel.flux(1.999), 4.0 / 3, 1e-3);
  for (const double shift : {0.3, 0.5, 0.8})
    EXPECT_NEAR(channel.drag({{shift * h, -1}, 0.5}) / drag, 1, 0.01);
  EXPECT_NEAR(channel.drag({{0, -0.5}, 0.5}) / channel.drag({{0, -0.5 + 1e-4 * h}, 0.5}), 1, 0.01);
}

TEST(Degenerate, what_a_body_leaves_of_an_inlet_flows_out_at_the_other_end) {
  Channel channel;
  channel.solve({{{-2, 0.03}, 0.5}});
  const double let_in = 4.0 / 3 - ((0.53 - std::pow(0.53, 3) / 3) + (0.47 - std::pow(0.47, 3) / 3));
  EXPECT_NEAR(channel.flux(1.999), let_in, 0.01 * let_in);
}

TEST(Degenerate, a_body_leaves_through_an_outlet_step_by_step_and_its_force_vanishes) {
  Channel channel;
  const double inside = channel.drag({{1.5, 0.03}, 0.5});
  double before = inside;
  for (const double x : {1.7, 1.9, 2.0, 2.1, 2.3, 2.45, 2.499}) {
    const double drag = channel.drag({{x, 0.03}, 0.5});
    EXPECT_LT(drag, before) << x;
    EXPECT_GE(drag, 0) << x;
    EXPECT_NEAR(channel.flux(-1.999), 4.0 / 3, 1e-3) << x;
    before = drag;
  }
  EXPECT_LT(before, 0.05 * inside);  // of a plate in the outlet that shrinks: as one over its logarithm
  EXPECT_EQ(channel.drag({{2.5 + 1e-9, 0.03}, 0.5}), 0);
}

TEST(Degenerate, a_body_over_all_of_an_inlet_stops_the_flow) {
  Channel channel;
  EXPECT_EQ(channel.drag({{-4.9, 0}, 3.15}), 0);
  EXPECT_EQ(channel.flux(0), 0);
}

TEST(Degenerate, fluid_that_has_nowhere_to_go_is_refused_with_the_place) {
  const auto told = [](const std::string& text) {
    return text.find("as much fluid must enter as leaves; around (") != std::string::npos;
  };
  Channel channel, given(velocity("1-y^2", "0"));
  EXPECT_TRUE(told(refusal([&] { channel.drag({{4.9, 0}, 3.1}); })));  // the outlet is covered
  EXPECT_TRUE(told(refusal([&] { channel.drag({{0, 0}, 1.05}); })));   // the channel is blocked
  EXPECT_TRUE(told(refusal([&] { channel.drag({{0, 0}, 1}); })));      // and just so
  EXPECT_TRUE(told(refusal([&] { given.drag({{-2, 0.03}, 0.5}); })));  // half of one of two inlets
  EXPECT_EQ(refusal([&] { given.drag({{0, 0.03}, 0.5}); }), "");
}

}  // namespace
}  // namespace fpi::fluid
