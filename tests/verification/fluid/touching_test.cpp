/// Random packings of touching grains, whose contacts close pores off: none fails, and forces balance.
#include <gtest/gtest.h>

#include <random>

#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;
constexpr int n_grains = 100, n_cells = 64;

/// Discs of up to twice each other's radius in a unit torus, pushed apart until they overlap by no more than
/// a part in 200 of their distance. Centres lie in the cell.
std::vector<Disc> touching_packing(unsigned seed) {
  constexpr double solid_fraction = 0.82, allowed = 0.005;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Disc> grains;
  double area = 0;
  for (int i = 0; i < n_grains; ++i) {
    grains.push_back({{unit(random), unit(random)}, 0.7 + 0.7 * unit(random)});
    area += Surface(grains.back()).area();
  }
  for (Disc& grain : grains) grain.radius *= std::sqrt(solid_fraction / area);
  double overlap = 1;
  for (int round = 0; round < 20000 && overlap > allowed; ++round) {
    overlap = 0;
    for (int i = 0; i < n_grains; ++i)
      for (int j = 0; j < i; ++j) {
        Vec2 line = grains[i].centre - grains[j].centre;
        for (double& x : line) x -= std::round(x);
        const double wanted = grains[i].radius + grains[j].radius;
        if (line.squaredNorm() >= wanted * wanted) continue;
        const double distance = line.norm();
        overlap = std::max(overlap, 1 - distance / wanted);
        const Vec2 push = 0.5 * (wanted - distance) / distance * line;
        grains[i].centre += push;
        grains[j].centre -= push;
      }
  }
  EXPECT_LE(overlap, allowed) << seed;
  for (Disc& grain : grains) grain.centre -= grain.centre.array().floor().matrix();
  return grains;
}

/// The packing in a mesh, with the images of its grains that reach over sides that are not periodic.
std::vector<Interface> interfaces(const NavierStokes& solver, const std::vector<Disc>& grains, double ratio) {
  std::vector<Interface> out;
  const bool along_x = solver.mesh().period.along[0];
  for (const Disc& grain : grains)
    for (const double shift : {-1.0, 0.0, 1.0}) {
      const Disc image{grain.centre + Vec2(shift, 0), ratio * grain.radius};
      const bool reaches_in = image.centre.x() > -image.radius && image.centre.x() < 1 + image.radius;
      if (along_x ? shift != 0 : !reaches_in) continue;
      const double length = solver.arc_length(image);
      if (length > 0)
        out.push_back(circle(static_cast<Index>(out.size()), image.centre, image.radius, length));
    }
  return out;
}

struct Drive {
  std::string name;
  Settings settings;
  std::array<bool, 2> periodic;
};

std::vector<Drive> drives() {
  auto cell = settings(1, 1, {});
  cell.fluid.pressure_drop = {"1", "0"};
  auto sides = settings(1, 1, {{"left", open("1", "0")}, {"right", open()}});
  auto rate = cell;
  rate.fluid.pressure_drop = {"0", "0"};
  rate.fluid.superficial_velocity = {"1e-4", "0"};
  return {{"a periodic cell", cell, {true, true}},
          {"a fall between sides", sides, {false, true}},
          {"a superficial velocity", rate, {true, true}}};
}

/// `ratio` of the radius that the fluid sees. A flow is forced through open packings only.
void expect_none_fails(double ratio, bool lets_through) {
  double worst_balance = 0, least = 1e300, most = 0;
  std::size_t most_parts = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const std::vector<Disc> grains = touching_packing(seed);
    for (Drive& drive : drives()) {
      if (!drive.settings.fluid.superficial_velocity.empty() && !lets_through) continue;
      drive.settings.fluid.convection = false;
      drive.settings.fluid.linear_solver = linear_solvers().back();  // MUMPS is four times faster here
      const auto lines = uniform_lines(0, 1, n_cells);
      NavierStokes solver(make_rectangle(lines, lines, {}, drive.periodic), drive.settings);
      const Result result = solve_steady(solver, interfaces(solver, grains, ratio));
      ASSERT_TRUE(result.newton.converged) << drive.name << ", seed " << seed << ": " << result.newton.reason;
      const ForceBalance balance = *solver.force_balance();
      EXPECT_LT(balance.relative(), 1e-8) << drive.name << ", seed " << seed;
      worst_balance = std::max(worst_balance, balance.relative());
      most_parts = std::max(most_parts, solver.n_closed_parts());
      const double k = solver.superficial_velocity().x() / *solver.pressure_fall(0);
      if (lets_through) {
        EXPECT_GT(k, 0) << drive.name << ", seed " << seed;
      }
      least = std::min(least, k);
      most = std::max(most, k);
    }
  }
  std::cout << fmt::format(
      "hydraulic radius ratio {}: permeability {:.3g} to {:.3g} m², up to {} closed parts, forces balance to "
      "{:.1e}\n",
      ratio, least, most, most_parts, worst_balance);
}

TEST(TouchingPackings, that_close_their_pores_are_solved_in_every_way_to_drive_them) {
  expect_none_fails(1, false);
}
TEST(TouchingPackings, that_the_fluid_sees_smaller_let_it_through) { expect_none_fails(0.8, true); }

}  // namespace
}  // namespace fpi::fluid
