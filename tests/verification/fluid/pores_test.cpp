/// Bodies that touch, overlap a little and close pores off: the fluid between them stays determined, finite
/// and at rest where nothing moves it.
#include <gtest/gtest.h>

#include <random>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

Settings stokes(std::map<std::string, scene::Boundary> boundaries) {
  Settings s = settings(1, 1, std::move(boundaries));
  s.fluid.convection = false;
  return s;
}
std::map<std::string, scene::Boundary> box(const scene::Boundary& top = no_slip()) {
  return {{"left", no_slip()}, {"right", no_slip()}, {"bottom", no_slip()}, {"top", top}};
}
std::map<std::string, scene::Boundary> channel(const scene::Boundary& left) {
  return {{"left", left}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}};
}

Interface disc(const NavierStokes& solver, Index body, const Vec2& centre, double radius, double turn = 0) {
  return circle(body, centre, radius, solver.arc_length(Disc{centre, radius}), turn);
}

/// `n` equal discs in a ring around `centre` that overlap by `overlap` of a diameter, with a pore between.
std::vector<Interface> ring_of_discs(const NavierStokes& solver, int n, const Vec2& centre, double radius,
                                     double overlap, double turn) {
  std::vector<Interface> discs;
  const double ring = radius * (1 - overlap) / std::sin(pi / n);
  for (int i = 0; i < n; ++i) {
    const double angle = turn + 2 * pi * i / n;
    discs.push_back(disc(solver, i, centre + ring * Vec2(std::cos(angle), std::sin(angle)), radius, 0.7 * i));
  }
  return discs;
}

/// Largest velocity at a node that no body covers, largest pressure and traction.
struct Extent {
  double velocity = 0, pressure = 0, traction = 0;
};
Extent extent(const NavierStokes& solver, const std::vector<Interface>& bodies, const Result& result) {
  Extent out;
  for (Index node = 0; node < solver.mesh().n_nodes(); ++node) {
    const Vec2 x = solver.mesh().node_position(node);
    const bool covered = std::any_of(bodies.begin(), bodies.end(),
                                     [&](const Interface& body) { return body.surface.contains(x); });
    if (!covered) out.velocity = std::max(out.velocity, solver.state().u.segment<2>(2 * node).norm());
  }
  out.pressure = solver.state().p.cwiseAbs().maxCoeff();
  for (const BodyTraction& body : result.tractions)
    for (const Vec2& lambda : body.lambda) out.traction = std::max(out.traction, lambda.norm());
  return out;
}

double flux_through_line(const NavierStokes& solver, double x) {
  double flux = 0;
  constexpr int parts = 400;
  for (int k = 0; k < parts; ++k) flux += solver.at({x, (k + 0.5) / parts})->first.x() / parts;
  return flux;
}

TEST(Pores, between_overlapping_discs_have_their_own_pressure_level_and_stay_at_rest) {
  for (const int n : {3, 4}) {
    NavierStokes solver(square(40), stokes(box(velocity("16*x^2*(1-x)^2", "0"))));
    const Vec2 middle(0.513, 0.431);
    const std::vector<Interface> discs = ring_of_discs(solver, n, middle, 0.15, 0.03, 0.2);
    const Result result = solve_steady(solver, discs);
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    EXPECT_LT(solver.at(middle)->first.norm(), 1e-5) << n;
    EXPECT_LT(std::abs(solver.at(middle)->second), 1e-2) << n;  // pinned by itself, whatever is outside
    EXPECT_GT(solver.at({0.9, 0.9})->first.norm(), 1e-2) << n;
  }
}

TEST(Pores, are_found_as_parts_of_the_mesh) {
  const Space space(square(40), box());
  const NavierStokes solver(square(40), stokes(box()));
  for (const int n : {3, 4}) {
    const auto discs = ring_of_discs(solver, n, {0.513, 0.431}, 0.15, 0.03, 0.2);
    CutMesh cut = cut_mesh(space.mesh, space.locator, discs);
    Components parts = find_components(space.mesh, cut);
    EXPECT_EQ(parts.n(), 2);
    const Numbering numbering = number_unknowns(space.mesh, space.boundary, cut, parts, discs);
    ASSERT_EQ(numbering.pinned.size(), 2u);  // one outside, one in the pore
    const auto distance = [&](Index v) { return (space.mesh.vertices[v] - Vec2(0.513, 0.431)).norm(); };
    EXPECT_LT(std::min(distance(numbering.pinned[0]), distance(numbering.pinned[1])), 0.06 * n - 0.1);
  }
}

/// A square hole `width` elements wide between four slabs, turned by `angle`.
std::vector<Interface> hole_between_slabs(const Vec2& centre, double width, double h, double angle) {
  const double w = 0.5 * width * h, far = 0.3;
  const std::array<std::array<double, 4>, 4> slabs{{{-far, w, far, far},
                                                    {-far, -far, far, -w},
                                                    {-far, -w - 0.5 * h, -w, w + 0.5 * h},
                                                    {w, -w - 0.5 * h, far, w + 0.5 * h}}};
  std::vector<Interface> out;
  for (const auto& [x0, y0, x1, y1] : slabs) {
    const std::array<Vec2, 4> corners{Vec2(x0, y0), Vec2(x1, y0), Vec2(x1, y1), Vec2(x0, y1)};
    std::vector<Vec2> vertices;
    for (int k = 0; k < 4; ++k) {
      const Vec2 from = corners[k], along = corners[(k + 1) % 4] - from;
      const int n = std::max(1, static_cast<int>(std::lround(along.norm() / h)));
      for (int j = 0; j < n; ++j)
        vertices.push_back(centre + Eigen::Rotation2Dd(angle) * (from + along * j / n));
    }
    Interface slab;
    slab.body = static_cast<Index>(out.size());
    slab.rigid = {centre, Vec2(0.1, 0), 0.3};
    set_edges(slab, vertices);
    out.push_back(std::move(slab));
  }
  return out;
}

/// In such a hole neither its pressure nor, without a multiplier, its velocity would be determined.
TEST(Pores, of_about_an_element_are_determined_or_left_out) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double width : {0.1, 0.3, 0.7, 1.0, 2.0})
    for (int i = 0; i < 8; ++i) {
      NavierStokes solver(square(20), stokes(box()));
      const Vec2 centre(0.5 + 0.05 * unit(random), 0.5 + 0.05 * unit(random));
      const auto slabs = hole_between_slabs(centre, width, 0.05, 6 * unit(random));
      const Result result = solve_steady(solver, slabs);
      ASSERT_TRUE(result.newton.converged) << width << " " << i << " " << result.newton.reason;
      const Extent found = extent(solver, slabs, result);
      EXPECT_LT(found.velocity, 1) << width << " " << i;
      EXPECT_LT(found.pressure, 1e3) << width << " " << i;
      EXPECT_LT(found.traction, 1e3) << width << " " << i;
    }
}

/// Grains of up to twice each other's radius, drawn together and pushed apart until they overlap by `overlap`
/// of their distance at most.
std::vector<Disc> packing(unsigned seed, int n, double overlap) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Disc> grains;
  for (int i = 0; i < n; ++i) {
    const Vec2 centre(unit(random), unit(random));
    grains.push_back({centre, 0.06 * (0.7 + 0.6 * unit(random))});
  }
  for (int round = 0; round < 2000; ++round) {
    if (round < 1500)
      for (Disc& grain : grains) grain.centre += 0.002 * (Vec2(0.5, 0.5) - grain.centre);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j) {
        const Vec2 line = grains[i].centre - grains[j].centre;
        const double distance = line.norm(), wanted = (grains[i].radius + grains[j].radius) * (1 - overlap);
        if (distance >= wanted) continue;
        const Vec2 push = 0.5 * (wanted - distance) / distance * line;
        grains[i].centre += push;
        grains[j].centre -= push;
      }
  }
  return grains;
}

TEST(Pores, of_random_packings_stay_finite_and_lose_no_fluid) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    NavierStokes solver(square(40), stokes(channel(open("1", "0"))));
    std::vector<Interface> grains;
    for (const Disc& grain : packing(seed, 30, 0.005 * (seed % 4)))
      if (solver.arc_length(grain) > 0)
        grains.push_back(disc(solver, static_cast<Index>(grains.size()), grain.centre, grain.radius, seed));
    const Result result = solve_steady(solver, grains);
    ASSERT_TRUE(result.newton.converged) << seed << " " << result.newton.reason;
    const Extent found = extent(solver, grains, result);
    EXPECT_LT(found.velocity, 0.13) << seed;  // of the empty channel
    EXPECT_LT(found.pressure, 1.5) << seed;
    EXPECT_LT(found.traction, 5) << seed;
    const double in = flux_through_line(solver, 0.001), out = flux_through_line(solver, 0.999);
    EXPECT_NEAR(in, out, 1e-3 / 12) << seed;  // of what the empty channel carries
    EXPECT_LT(solver.force_balance()->relative(), 1e-8) << seed;
  }
}

/// Five discs from wall to wall, overlapping each other and the walls.
std::vector<Interface> chain(const NavierStokes& solver) {
  std::vector<Interface> discs;
  for (int i = 0; i < 5; ++i) discs.push_back(disc(solver, i, {0.51 + 0.01 * (i % 2), 0.1 + 0.2 * i}, 0.11));
  return discs;
}

TEST(Pores, a_chain_from_wall_to_wall_takes_the_whole_pressure_and_lets_nothing_through) {
  NavierStokes solver(square(40), stokes(channel(open("1", "0"))));
  const auto discs = chain(solver);
  const Result result = solve_steady(solver, discs);
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  double force = 0;
  for (const BodyTraction& body : result.tractions) force += body.force.x();
  EXPECT_NEAR(force, 1, 4e-3);
  EXPECT_LT(extent(solver, discs, result).velocity, 1e-4);
  EXPECT_NEAR(solver.at({0.1, 0.5})->second, 1, 1e-4);
  EXPECT_NEAR(solver.at({0.9, 0.5})->second, 0, 1e-4);
}

TEST(Pores, between_discs_that_press_into_each_other_shrink) {
  NavierStokes solver(square(40), stokes(channel(open())));
  const Vec2 middle(0.513, 0.431);
  std::vector<Interface> discs = ring_of_discs(solver, 3, middle, 0.15, 0.01, 0.2);
  for (Interface& d : discs) d.rigid.translation = 1e-2 * (middle - d.rigid.centre).normalized();
  const Result result = solve_steady(solver, discs);
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  const Extent found = extent(solver, discs, result);
  EXPECT_LT(found.velocity, 0.1);  // ten times the discs' speed
  EXPECT_LT(found.pressure, 1e3);
  EXPECT_LT(found.traction, 1e3);
}

TEST(Pores, a_flow_rate_into_a_blocked_channel_is_refused) {
  NavierStokes solver(square(40), stokes(channel(velocity("y*(1-y)", "0"))));
  try {
    solve_steady(solver, chain(solver));
    FAIL() << "no error";
  } catch (const Error& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("as much fluid must enter as leaves; around ("), std::string::npos) << what;
    EXPECT_NE(what.find("m²/s enters"), std::string::npos) << what;
  }
}

TEST(Pores, a_flow_rate_whose_pressure_is_to_be_found_needs_a_way_out) {
  scene::Boundary inlet = open();
  inlet.flow_rate = "0.1";
  NavierStokes blocked(square(40), stokes(channel(inlet)));
  auto walls = box();
  walls["left"] = inlet;
  NavierStokes closed(square(10), stokes(walls));
  for (const auto& [solver, discs] :
       {std::pair{&blocked, chain(blocked)}, {&closed, std::vector<Interface>{}}})
    try {
      solve_steady(*solver, discs);
      ADD_FAILURE() << "no error";
    } catch (const Error& e) {
      const std::string what = e.what();
      EXPECT_NE(what.find("\"left\" needs a way to another boundary"), std::string::npos) << what;
    }
}

}  // namespace
}  // namespace fpi::fluid
