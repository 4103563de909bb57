/// Flow through grains that hold: drag in periodic arrays, flows of a given rate, and the balance of forces.
#include <gtest/gtest.h>

#include <random>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;
constexpr double of_quadrature = 1e-9;  // error of flows of some 0.1 m²/s at the cut of a circle

Settings stokes(std::map<std::string, scene::Boundary> boundaries = {}) {
  Settings s = settings(1, 1, std::move(boundaries));
  s.fluid.convection = false;
  return s;
}

Mesh torus(int nx, int ny, double height = 1) {
  return make_rectangle(uniform_lines(0, 1, nx), uniform_lines(0, height, ny), {}, {true, true});
}

Interface disc(const NavierStokes& solver, Index body, const Vec2& centre, double radius) {
  return circle(body, centre, radius, solver.arc_length(Disc{centre, radius}));
}

/// F/(μU) of one cylinder a cell, from the velocity for a unit fall of the pressure.
double drag(NavierStokes& solver, const std::vector<Interface>& discs, double cell_area) {
  const Result result = solve_steady(solver, discs);
  EXPECT_TRUE(result.newton.converged) << result.newton.reason;
  return cell_area / static_cast<double>(discs.size()) / solver.superficial_velocity().x();
}

double drag_of_square_array(double fraction, int n, const Vec2& centre) {
  auto s = stokes();
  s.fluid.pressure_drop = {"1", "0"};
  NavierStokes solver(torus(n, n), s);
  return drag(solver, {disc(solver, 0, centre, std::sqrt(fraction / pi))}, 1);
}

/// Sangani & Acrivos (1982), the coarsest uniform meshes that do it wherever the grain lies in them. At 0.75
/// their 126 300 is 1 % below a body-fitted computation (127 530, FreeFem++ on a quarter of the cell) and the
/// theory of narrow gaps (127 400, see the next test): the former is taken.
TEST(Percolation, drag_of_square_arrays_is_that_of_sangani_and_acrivos) {
  struct Case {
    double fraction, expected;
    int cells;
    double tolerance;
  };
  for (const auto& [fraction, expected, n, tolerance] : {Case{0.05, 15.56, 24, 1e-3},
                                                         {0.10, 24.83, 20, 1e-3},
                                                         {0.20, 51.53, 16, 1e-3},
                                                         {0.30, 102.90, 16, 1e-3},
                                                         {0.40, 217.89, 16, 1e-3},
                                                         {0.50, 532.55, 20, 1e-3},
                                                         {0.60, 1763, 28, 1e-3},
                                                         {0.70, 13520, 24, 5e-3},
                                                         {0.75, 127530, 36, 5e-3}}) {
    double worst = 0;
    for (const Vec2& offset :
         {Vec2(0, 0), Vec2(0.5, 0.5), Vec2(0.25, 0.1), Vec2(0.37, 0.61), Vec2(0.83, 0.71)})
      worst = std::max(
          worst, std::abs(drag_of_square_array(fraction, n, Vec2(0.5, 0.5) + offset / n) / expected - 1));
    std::cout << fmt::format("square array {:.2f}, {} cells a side: worst of 5 places {:.3f} %\n", fraction,
                             n, 100 * worst);
    EXPECT_LT(worst, tolerance) << fraction;
  }
}

/// F/(μU) = 9π/(2√2) ε^(−5/2) for ε = 1 − √(φ/φmax) → 0.
TEST(Percolation, drag_of_dense_square_arrays_tends_to_that_of_narrow_gaps) {
  const double fraction = 0.75, gap = 1 - std::sqrt(fraction / (pi / 4));
  const double theory = 9 * pi / (2 * std::sqrt(2.0)) * std::pow(gap, -2.5);
  EXPECT_NEAR(drag_of_square_array(fraction, 64, {0.503, 0.507}), theory, 3e-3 * theory);
}

/// Drummond & Tahir (1984): 8π/(−ln φ − 1.498 + 2φ − φ²/2) for a triangular array, whose cells are hexagons.
TEST(Percolation, drag_of_dilute_hexagonal_arrays_is_that_of_the_series) {
  const double height = std::sqrt(3.0);
  for (const auto& [fraction, n] : {std::pair{0.02, 48}, {0.05, 32}, {0.1, 24}}) {
    auto s = stokes();
    s.fluid.pressure_drop = {"1", "0"};
    NavierStokes solver(torus(n, std::lround(n * height), height), s);
    const double radius = std::sqrt(fraction * height / (2 * pi));
    const double found =
        drag(solver,
             {disc(solver, 0, {0.26, 0.27 * height}, radius), disc(solver, 1, {0.76, 0.77 * height}, radius)},
             height);
    const double series = 8 * pi / (-std::log(fraction) - 1.498 + 2 * fraction - fraction * fraction / 2);
    std::cout << fmt::format("hexagonal array {:.2f}: {:.5g}, series {:.5g}\n", fraction, found, series);
    EXPECT_NEAR(found, series, 2e-3 * series) << fraction;
  }
}

std::vector<Interface> some_discs(const NavierStokes& solver) {
  return {disc(solver, 0, {0.31, 0.27}, 0.14), disc(solver, 1, {0.68, 0.71}, 0.17),
          disc(solver, 2, {0.97, 0.21}, 0.11)};
}

TEST(Percolation, a_superficial_velocity_is_met_and_its_pressure_drop_gives_the_same_flow) {
  for (const bool convection : {false, true}) {
    auto s = settings(3, 0.05, {});
    s.fluid.convection = convection;
    s.fluid.newton.relative_tolerance = 1e-11;
    auto by_drop = s;
    s.fluid.superficial_velocity = {"0.4", "0.1"};
    NavierStokes given(torus(20, 20), s);
    const Result result = solve_steady(given, some_discs(given));
    ASSERT_TRUE(result.newton.converged) << result.newton.reason;
    EXPECT_LT((given.superficial_velocity() - Vec2(0.4, 0.1)).norm(), 1e-11);
    const auto found = given.found_drives();
    by_drop.fluid.pressure_drop = {fmt::format("{:.17g}", found.at("pressure_drop_x")),
                                   fmt::format("{:.17g}", found.at("pressure_drop_y"))};
    NavierStokes driven(torus(20, 20), by_drop);
    const Result same = solve_steady(driven, some_discs(driven));
    EXPECT_LT((driven.superficial_velocity() - Vec2(0.4, 0.1)).norm(), 1e-8);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_LT((same.tractions[i].force - result.tractions[i].force).norm(),
                1e-8 * result.tractions[i].force.norm());
    EXPECT_LT(given.force_balance()->relative(), 1e-9);
  }
}

TEST(Percolation, a_flow_rate_through_a_channel_finds_the_pressure_of_poiseuille_flow) {
  scene::Boundary inlet = open();
  inlet.flow_rate = "t+2/3";
  auto s = stokes({{"left", inlet}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.viscous_form = "gradient";  // whose open ends are passed without a change
  NavierStokes solver(make_rectangle(uniform_lines(0, 3, 12), uniform_lines(0, 2, 6)), s);
  ASSERT_TRUE(solve_steady(solver).newton.converged);
  EXPECT_NEAR(solver.found_drives().at("pressure_at_left"), 3, 1e-10);  // 12 μ Q length / height³
  EXPECT_NEAR(solver.at({1.3, 1})->first.x(), 0.5, 1e-11);
  EXPECT_LT(solver.force_balance()->relative(), 1e-12);
}

TEST(Percolation, a_flow_rate_past_grains_between_slip_walls_leaves_at_the_other_end) {
  scene::Boundary inlet = open();
  inlet.flow_rate = "0.3";
  auto s = settings(1, 0.02, {{"left", inlet}, {"right", open()}, {"bottom", slip()}, {"top", slip()}});
  s.fluid.newton.relative_tolerance = 1e-11;
  NavierStokes solver(make_rectangle(uniform_lines(-0.5, 2, 50), uniform_lines(0, 1, 20)), s);
  const Result result = solve_steady(solver, some_discs(solver));
  ASSERT_TRUE(result.newton.converged) << result.newton.reason;
  double out = 0;
  for (int k = 0; k < 400; ++k) out += solver.at({2, (k + 0.5) / 400})->first.x() / 400;
  EXPECT_NEAR(out, 0.3, 1e-4);
  const ForceBalance balance = *solver.force_balance();
  EXPECT_LT(balance.relative(), 1e-8);
  // The walls take no shear: what drives along the channel ends on the grains and with the fluid.
  for (const auto& [name, force] : balance.terms)
    if (name == "boundary:top" || name == "boundary:bottom") {
      EXPECT_NEAR(force.x(), 0, 1e-12) << name;
    }
}

/// Terms of different kind in each: what is left of their sum over the largest.
TEST(Percolation, forces_balance_in_every_way_to_drive_a_steady_flow) {
  const auto tight = [](Settings s) {
    s.fluid.newton.relative_tolerance = 1e-10;
    return s;
  };
  const auto rest = [](Mesh mesh, Settings s) {
    NavierStokes solver(std::move(mesh), std::move(s));
    const Result result = solve_steady(solver, some_discs(solver));
    EXPECT_TRUE(result.newton.converged) << result.newton.reason;
    const ForceBalance balance = *solver.force_balance();
    for (const auto& [name, force] : balance.terms)
      std::cout << fmt::format("{} ({:.4g}, {:.4g}), ", name, force.x(), force.y());
    std::cout << fmt::format("rest {:.1e}\n", balance.relative());
    // Without an open side one vertex, whose pressure is given, takes what leaks.
    const VolumeBalance volumes = *solver.volume_balance();
    const double leak = solver.n_closed_parts() > 0 ? volumes.terms.back().inflow : 0;
    EXPECT_NEAR(volumes.rest(), leak, of_quadrature);
    return balance.relative();
  };
  const auto channel = [] { return make_rectangle(uniform_lines(-0.5, 2, 50), uniform_lines(0, 1, 20)); };
  const auto walls = [](const scene::Boundary& left) {
    return std::map<std::string, scene::Boundary>{
        {"left", left}, {"right", open()}, {"bottom", no_slip()}, {"top", slip()}};
  };
  auto periodic = settings(1, 0.02, {});
  periodic.fluid.pressure_drop = {"0.3", "0.1"};
  periodic.fluid.body_force = {"0.1*sin(6*x)", "y"};
  EXPECT_LT(rest(torus(20, 20), tight(periodic)), 1e-8);
  EXPECT_LT(rest(channel(), tight(settings(1, 0.02, walls(velocity("y*(1-y)", "0"))))), 1e-8);
  EXPECT_LT(rest(channel(), tight(settings(1, 0.02, walls(open("0.2", "0.01*y"))))), 1e-8);
  auto gradient = settings(2, 0.02, walls(velocity("y*(1-y)", "0")));
  gradient.fluid.viscous_form = "gradient";
  gradient.gravity = {0, -9.81};
  EXPECT_LT(rest(channel(), tight(gradient)), 1e-8);
}

TEST(Percolation, forces_balance_while_a_disc_moves) {
  auto s = settings(
      1, 0.05,
      {{"left", velocity("y*(1-y)", "0")}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.bodies_move = true;
  s.fluid.newton.relative_tolerance = 1e-10;
  NavierStokes solver(make_rectangle(uniform_lines(0, 2, 24), uniform_lines(0, 1, 12)), s);
  for (int k = 1; k <= 4; ++k) {
    Interface moving = circle(0, {0.6 + 0.02 * k, 0.44}, 0.15, 1.0 / 12);
    moving.rigid.translation = {1, 0};
    ASSERT_TRUE(solver.advance({0.02 * k, 0.02, 0, {moving}}).newton.converged);
    solver.accept();
    EXPECT_LT(solver.force_balance()->relative(), 1e-8) << k;
    EXPECT_NEAR(solver.volume_balance()->rest(), 0, of_quadrature) << k;
  }
}

/// A disc half-way through an open side pushes fluid ahead that comes back in beside it.
TEST(Percolation, volumes_balance_while_a_disc_leaves) {
  auto s =
      settings(1, 0.05, {{"left", no_slip()}, {"right", open()}, {"bottom", no_slip()}, {"top", no_slip()}});
  s.bodies_move = true;
  s.fluid.newton.relative_tolerance = 1e-10;
  NavierStokes solver(make_rectangle(uniform_lines(0, 2, 24), uniform_lines(0, 1, 12)), s);
  constexpr double speed = 0.5, radius = 0.2;
  Interface leaving = circle(0, {2, 0.47}, radius, 1.0 / 12);
  leaving.rigid.translation = {speed, 0};
  ASSERT_TRUE(solver.advance({0.01, 0.01, 0, {leaving}}).newton.converged);
  solver.accept();
  const VolumeBalance balance = *solver.volume_balance();
  std::map<std::string, double> inflow;
  for (const auto& [name, value] : balance.terms) inflow[name] = value;
  EXPECT_NEAR(inflow["bodies"], -2 * radius * speed,
              1e-12);  // the half that is inside moves out of the fluid
  EXPECT_NEAR(inflow["boundary:right"], 2 * radius * speed, 1e-2 * radius * speed);
  EXPECT_NEAR(inflow["boundary:left"], 0, 1e-15);
  EXPECT_NEAR(balance.rest(), 0, of_quadrature);
}

TEST(Percolation, a_channel_has_the_permeability_of_poiseuille_flow_and_no_detours) {
  const double height = 0.6;
  auto s = settings(1, 0.3, {{"bottom", no_slip()}, {"top", no_slip()}});
  s.fluid.pressure_drop = {"2", "0"};
  NavierStokes solver(make_rectangle(uniform_lines(0, 1, 4), uniform_lines(0, height, 5), {}, {true, false}),
                      s);
  ASSERT_TRUE(solve_steady(solver).newton.converged);
  const Eigen::Matrix2d k = solver.permeability();
  EXPECT_NEAR(k(0, 0), height * height / 12, 1e-13);
  EXPECT_EQ(k(1, 1), 0);  // across there is none
  const PoreFlow flow = solver.pore_flow();
  EXPECT_NEAR(flow.porosity(), 1, 1e-13);
  EXPECT_NEAR(flow.superficial_velocity().x(), k(0, 0) * 2 / 0.3, 1e-12);
  EXPECT_NEAR(flow.tortuosity(0), 1, 1e-12);
  const auto slabs = solver.sections(0, 4);
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(slabs[i - 1].pressure - slabs[i].pressure, 0.5, 1e-11);
  EXPECT_NEAR(*solver.pressure_fall(0), 2, 1e-12);
}

TEST(Percolation, porosity_and_wetted_surface_are_those_of_the_circles) {
  NavierStokes solver(torus(16, 16), stokes());
  const auto discs = some_discs(solver);
  ASSERT_TRUE(solve_steady(solver, discs).newton.converged);
  double area = 0, length = 0;
  for (const Interface& grain : discs) {
    area += grain.surface.area();
    length += 2 * std::sqrt(pi * grain.surface.area());
  }
  EXPECT_NEAR(solver.pore_flow().porosity(), 1 - area, 1e-8);
  EXPECT_NEAR(solver.pore_flow().specific_surface(), length, 1e-8);
}

TEST(Percolation, the_tensor_is_symmetric_and_says_what_a_fall_of_pressure_does) {
  auto s = stokes();
  s.fluid.pressure_drop = {"0.3", "-0.2"};
  NavierStokes solver(torus(20, 20), s);
  ASSERT_TRUE(solve_steady(solver, some_discs(solver)).newton.converged);
  const Eigen::Matrix2d k = solver.permeability();
  EXPECT_NEAR(k(0, 1), k(1, 0), 1e-12 * k(0, 0));
  EXPECT_GT(std::abs(k(0, 1)), 1e-3 * k(0, 0));
  EXPECT_LT((k * Vec2(0.3, -0.2) - solver.superficial_velocity()).norm(), 1e-10 * k.norm());
  auto fast = s;  // at a Reynolds number the tensor is the same
  fast.fluid.convection = true;
  fast.fluid.density = 100;
  NavierStokes convected(torus(20, 20), fast);
  ASSERT_TRUE(solve_steady(convected, some_discs(convected)).newton.converged);
  EXPECT_LT((convected.permeability() - k).norm(), 1e-12 * k.norm());
}

TEST(Percolation, what_passes_is_the_same_in_every_section_and_all_fluid_has_a_velocity) {
  auto s = stokes();
  s.fluid.superficial_velocity = {"1", "0"};
  NavierStokes solver(torus(24, 24), s);
  ASSERT_TRUE(solve_steady(solver, some_discs(solver)).newton.converged);
  for (const Section& slab : solver.sections(0, 4)) EXPECT_NEAR(slab.velocity, 1, 5e-3);
  double shares = 0, mean = 0;
  for (const SpeedBin& bin : solver.speed_histogram(0, 200)) {
    shares += bin.share;
    mean += bin.share * (bin.from + bin.to) / 2;
  }
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_NEAR(mean, solver.pore_flow().pore_velocity().x(), 0.01);
  EXPECT_GT(solver.pore_flow().tortuosity(0), 1);
}

}  // namespace
}  // namespace fpi::fluid
