/// Tractions and forces on fitted boundaries, recovered from the residual.
#include <gtest/gtest.h>

#include "../../unit/fluid/ring.hpp"
#include "stress/fluid_case.hpp"

namespace fpi::fluid {
namespace {

using namespace testing;

/// σn of an exact flow on a boundary with this outer normal, at a point.
using Exact = std::function<Vec2(const Vec2& x, const std::string& boundary)>;

double largest_error(const NavierStokes& solver, const Exact& exact) {
  double largest = 0;
  for (std::size_t b = 0; b < solver.boundary_curves().size(); ++b) {
    const BoundaryCurve& curve = solver.boundary_curves()[b];
    for (std::size_t i = 0; i < curve.nodes.size(); ++i) {
      const Vec2 x = solver.mesh().node_position(curve.nodes[i]);
      const Vec2 error = solver.boundary_tractions()[b].values[i] - exact(x, curve.name);
      largest = std::max(largest, error.norm());
    }
  }
  return largest;
}

const BoundaryTraction& traction_on(const NavierStokes& solver, const std::string& name) {
  const auto& curves = solver.boundary_curves();
  const auto found =
      std::find_if(curves.begin(), curves.end(), [&](const auto& c) { return c.name == name; });
  return solver.boundary_tractions()[found - curves.begin()];
}

Vec2 outer_normal(const std::string& side) {
  if (side == "left") return {-1, 0};
  if (side == "right") return {1, 0};
  return {0, side == "bottom" ? -1.0 : 1.0};
}

Settings poiseuille(double mu) {
  return settings(1.3, mu,
                  {{"left", velocity("4*y*(1-y)", "0")},
                   {"right", open("0", std::to_string(mu) + "*4*(1-2*y)")},
                   {"bottom", no_slip()},
                   {"top", no_slip()}});
}

TEST(BoundaryTraction, is_exact_for_poiseuille_flow_up_to_the_corners) {
  const double mu = 0.7;
  NavierStokes solver(make_rectangle(uniform_lines(0, 2, 6), uniform_lines(0, 1, 5)), poiseuille(mu));
  ASSERT_TRUE(solve_steady(solver).newton.converged);
  const Exact exact = [&](const Vec2& x, const std::string& side) {
    const Vec2 n = outer_normal(side);
    const double shear = mu * (4 - 8 * x.y()), p = 8 * mu * (2 - x.x());
    return Vec2(p * n.x() - shear * n.y(), p * n.y() - shear * n.x());  // −σn: of the fluid on the boundary
  };
  EXPECT_LT(largest_error(solver, exact), 1e-11);
  EXPECT_NEAR(traction_on(solver, "bottom").force.x(), 4 * mu * 2, 1e-11);
  EXPECT_NEAR(traction_on(solver, "bottom").force.y(), -16 * mu, 1e-11);  // ∫ p
  EXPECT_NEAR(traction_on(solver, "left").force.x(), -16 * mu, 1e-11);
}

TEST(BoundaryTraction, is_exact_for_couette_flow_between_corners_of_two_walls) {
  const double mu = 0.3;
  const auto shear = velocity("2*y", "0");
  NavierStokes solver(
      square(3), settings(1, mu, {{"left", shear}, {"right", shear}, {"bottom", shear}, {"top", shear}}));
  ASSERT_TRUE(solve_steady(solver).newton.converged);
  const double p = solver.state().p[0];
  const Exact exact = [&](const Vec2&, const std::string& side) {
    const Vec2 n = outer_normal(side);
    return Vec2(p * n.x() - 2 * mu * n.y(), p * n.y() - 2 * mu * n.x());
  };
  EXPECT_LT(largest_error(solver, exact), 1e-12);
}

/// Every edge of a square's boundary with a name of its own, so that each line has corners at both ends.
TEST(BoundaryTraction, of_a_line_between_two_corners_is_constant_and_right_for_couette_flow) {
  const double mu = 0.3;
  Mesh mesh = square(3);
  const std::vector<std::string> sides = mesh.boundary_names;
  std::map<std::string, scene::Boundary> conditions;
  mesh.boundary_names.clear();
  for (BoundaryEdge& b : mesh.boundary) {
    mesh.boundary_names.push_back(fmt::format("{}{}", sides[b.boundary], b.edge));
    conditions[mesh.boundary_names.back()] = velocity("2*y", "0");
    b.boundary = static_cast<Index>(mesh.boundary_names.size()) - 1;
  }
  NavierStokes solver(std::move(mesh), settings(1, mu, conditions));
  ASSERT_TRUE(solve_steady(solver).newton.converged);
  for (std::size_t b = 0; b < solver.boundary_curves().size(); ++b) {
    if (!solver.boundary_curves()[b].name.starts_with("top")) continue;
    for (const Vec2& value : solver.boundary_tractions()[b].values) EXPECT_NEAR(value.x(), -2 * mu, 1e-12);
  }
}

/// Relative errors of the torque on a shaft that turns in a case, on two meshes.
std::vector<double> torque_errors(bool curved) {
  const double mu = 0.5, spin = 2;
  std::vector<double> errors;
  for (const int n : {24, 48}) {
    auto s = settings(1, mu, {{"inner", velocity("-2*y", "2*x")}, {"outer", no_slip()}});
    s.fluid.convection = false;
    NavierStokes solver(make_ring(n, n / 6, 1, 2, curved), s);
    EXPECT_TRUE(solve_steady(solver).newton.converged);
    const BoundaryTraction& shaft = traction_on(solver, "inner");
    EXPECT_NEAR(solver.boundary_curves()[0].centre.norm(), 0, 1e-13);
    EXPECT_NEAR(shaft.torque, -traction_on(solver, "outer").torque, 1e-10);
    EXPECT_NEAR(shaft.force.norm(), 0, 1e-10);
    const double exact = -4 * std::numbers::pi * mu * spin / (1 - 0.25);
    errors.push_back(std::abs(shaft.torque / exact - 1));
  }
  return errors;
}

TEST(BoundaryTraction, of_a_shaft_that_turns_in_a_case_gives_taylor_couette_torque) {
  const auto straight = torque_errors(false), curved = torque_errors(true);
  EXPECT_LT(straight.back(), 0.01) << "polygons stand for the circles";
  EXPECT_GT(order(straight), 1.7);
  EXPECT_LT(curved.back(), 2e-4);
  EXPECT_GT(order(curved), 3.5) << curved[0] << " " << curved[1];
}

/// How far the forces on a skew channel's boundaries are from balancing the outlet's traction and the
/// momentum that enters and leaves.
double imbalance(int n, bool convection) {
  auto s = poiseuille(0.1);
  s.fluid.convection = convection;
  s.fluid.boundaries["left"] = velocity("16*y*(1-y)*(1-y)", "sin(pi*y)");
  s.fluid.boundaries["right"] = open("-1-y", "0.2");
  NavierStokes solver(make_rectangle(uniform_lines(0, 2, 2 * n), uniform_lines(0, 1, n)), s);
  EXPECT_TRUE(solve_steady(solver).newton.converged);
  Vec2 left = -Vec2(-1.5, 0.2);
  for (const BoundaryTraction& t : solver.boundary_tractions()) left += t.force;
  const int n_samples = convection ? 4000 : 0;
  for (int i = 0; i < n_samples; ++i)
    for (const double x : {0.0, 2.0}) {
      const Vec2 u = solver.at({x, (i + 0.5) / n_samples})->first;
      left -= (x == 0 ? 1 : -1) * 1.3 * u.x() * u / n_samples;
    }
  return left.norm();
}

TEST(BoundaryTraction, balances_what_acts_on_the_flow) {
  EXPECT_LT(imbalance(5, false), 1e-11);
  // Velocities of this element are divergence-free in the mean only, so momentum is kept to the order of the
  // scheme.
  const std::vector<double> errors{imbalance(5, true), imbalance(10, true)};
  EXPECT_LT(errors.back(), 1e-3);
  EXPECT_GT(order(errors), 2);
}

/// Kovasznay's flow at Re = 40 around its square; the traction of the elements, μ∇u − p n, has order 2 at
/// best.
TEST(BoundaryTraction, converges_on_the_boundary_of_kovasznays_flow) {
  const double mu = 1.0 / 40, k = 20 - std::sqrt(400 + 4 * std::numbers::pi * std::numbers::pi);
  const double two_pi = 2 * std::numbers::pi;
  const std::string e = fmt::format("exp({:.17g}*x)", k);
  const auto exact_velocity =
      velocity(fmt::format("1-{}*cos(2*pi*y)", e), fmt::format("{:.17g}*{}*sin(2*pi*y)/(2*pi)", k, e));
  std::vector<double> errors;
  for (const int n : {8, 16, 32}) {
    NavierStokes solver(square(n, -0.5, 0.5), settings(1, mu,
                                                       {{"left", exact_velocity},
                                                        {"right", exact_velocity},
                                                        {"bottom", exact_velocity},
                                                        {"top", exact_velocity}}));
    ASSERT_TRUE(solve_steady(solver).newton.converged);
    const auto pressure = [&](const Vec2& x) { return -0.5 * std::exp(2 * k * x.x()); };
    const double level = solver.at({0, 0})->second - pressure({0, 0});
    double square_sum = 0, length = 0;
    for (std::size_t b = 0; b < solver.boundary_curves().size(); ++b) {
      const BoundaryCurve& curve = solver.boundary_curves()[b];
      for (const auto& line : curve.lines) {
        const Vec2 x = solver.mesh().node_position(curve.nodes[line[2]]), normal = outer_normal(curve.name);
        const double a = std::exp(k * x.x()), cs = std::cos(two_pi * x.y()), sn = std::sin(two_pi * x.y());
        Eigen::Matrix2d gradient;
        gradient << -k * a * cs, two_pi * a * sn, k * k * a * sn / two_pi, k * a * cs;
        const Vec2 exact = (pressure(x) + level) * normal - mu * (gradient + gradient.transpose()) * normal;
        square_sum += (solver.boundary_tractions()[b].values[line[2]] - exact).squaredNorm();
        length += 1;
      }
    }
    errors.push_back(std::sqrt(square_sum / length));
  }
  for (const double error : errors) RecordProperty("error", std::to_string(error));
  EXPECT_GT(order(errors), 1.8) << errors[0] << " " << errors[1] << " " << errors[2];
  EXPECT_LT(errors.back(), 0.01);
}

}  // namespace
}  // namespace fpi::fluid
