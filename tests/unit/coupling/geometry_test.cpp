/// The interface mesh, the unknowns and the prescribed motion.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "coupling/interface_mesh.hpp"
#include "coupling/prescribed_motion.hpp"
#include "coupling/response.hpp"
#include "coupling/rigid_dofs.hpp"

namespace fpi::coupling {
namespace {

scene::Body disc(const std::string& motion = "free") {
  scene::Body body;
  body.name = "disc";
  body.radius = 0.5;
  body.density = 3;
  body.position = {1, 2};
  body.motion = motion;
  return body;
}

TEST(Arcs, cover_the_circle_without_gap_or_overlap) {
  for (const double length : {0.01, 0.3, 1.7, 100.}) {
    const Arcs arcs = cut_circle({1, 2, 0}, 0.5, length);
    EXPECT_EQ(arcs.start.front(), 0);
    EXPECT_EQ(arcs.end.back(), 2 * std::numbers::pi);
    for (std::size_t a = 1; a < arcs.size(); ++a) EXPECT_EQ(arcs.start[a], arcs.end[a - 1]);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      EXPECT_NEAR(arcs.end[a] - arcs.start[a], 2 * std::numbers::pi / static_cast<double>(arcs.size()),
                  1e-14);
    }
  }
}

TEST(Arcs, are_about_as_long_as_the_fluid_wants) {
  for (const double length : {0.01, 0.123, 0.4}) {
    const double given = std::numbers::pi / static_cast<double>(cut_circle({0, 0, 0}, 0.5, length).size());
    EXPECT_NEAR(given / length, 1, 0.1);
  }
}

TEST(Arcs, are_three_at_least) { EXPECT_EQ(cut_circle({0, 0, 0}, 0.5, 100).size(), 3u); }

TEST(Arcs, a_length_that_makes_no_sense_is_refused) {
  EXPECT_THROW(cut_circle({0, 0, 0}, 0.5, 0), Error);
  EXPECT_THROW(cut_circle({0, 0, 0}, 0.5, 1e-12), Error);
  EXPECT_THROW(cut_circle({0, 0, 0}, 0, 0.1), Error);
}

TEST(Edges, divide_each_side_equally_and_keep_the_corners) {
  const std::vector<double> corners{0, 0, 1, 0, 1, 0.3, 0, 0.3};
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  const Arcs edges = cut_polygon({5, 7, 0}, quarter, corners, 0.1);
  ASSERT_EQ(edges.size(), 26u);
  EXPECT_NEAR(edges.vertices[20], 5, 1e-15);  // corner (1, 0) after a quarter turn
  EXPECT_NEAR(edges.vertices[21], 8, 1e-15);
  for (std::size_t a = 0; a < edges.size(); ++a)
    EXPECT_NEAR((edges.from_centre(a, 1) - edges.from_centre(a, 0)).norm(), 0.1, 1e-14);
}

TEST(Edges, are_one_a_side_at_least_and_a_length_that_makes_no_sense_is_refused) {
  const std::vector<double> corners{0, 0, 1, 0, 0, 1};
  EXPECT_EQ(cut_polygon({0, 0, 0}, Eigen::Quaterniond::Identity(), corners, 100).size(), 3u);
  EXPECT_THROW(cut_polygon({0, 0, 0}, Eigen::Quaterniond::Identity(), corners, 0), Error);
  EXPECT_THROW(cut_polygon({0, 0, 0}, Eigen::Quaterniond::Identity(), corners, 1e-9), Error);
}

TEST(InterfaceVelocities, on_edges_are_those_of_the_rigid_motion) {
  const Arcs edges = cut_polygon({1, 2, 0}, Eigen::Quaterniond::Identity(), {0, 0, 1, 0, 0, 1}, 2);
  RigidMotion motion;
  motion.velocity = {3, -1, 0};
  motion.spin = {0, 0, 2};
  const std::vector<double> u = velocities_on(edges, motion);
  ASSERT_EQ(u.size(), 2 * points_per_arc * 3);
  EXPECT_NEAR(u[2], 3, 1e-15);  // the middle of the first side, (0.5, 0) from the centre
  EXPECT_NEAR(u[3], -1 + 2 * 0.5, 1e-15);
}

TEST(InterfaceVelocities, of_a_spin_are_tangent_and_of_a_translation_uniform) {
  const Arcs arcs = cut_circle({1, 2, 0}, 0.5, 0.4);
  RigidMotion motion;
  motion.velocity = {3, -1, 0};
  motion.spin = {0, 0, 2};
  const std::vector<double> u = velocities_on(arcs, motion);
  ASSERT_EQ(u.size(), 2 * points_per_arc * arcs.size());
  for (std::size_t p = 0; p < u.size(); p += 2) {
    EXPECT_NEAR(std::hypot(u[p] - 3, u[p + 1] + 1), 2 * 0.5, 1e-14);
  }
}

TEST(InterfaceVelocities, are_those_of_gauss_legendre_points) {
  // ∫ cos over an arc by the three points has the error of degree 6.
  const Arcs arcs = cut_circle({0, 0, 0}, 1, 0.5);
  RigidMotion motion;
  motion.spin = {0, 0, 1};
  const std::vector<double> u = velocities_on(arcs, motion);
  const double half = 0.5 * (arcs.end[0] - arcs.start[0]);
  const double integral = half * (5 * u[1] + 8 * u[3] + 5 * u[5]) / 9;
  EXPECT_NEAR(integral, std::sin(arcs.end[0]) - std::sin(arcs.start[0]), 1e-7);
}

TEST(RigidDofs, velocities_go_out_and_come_back) {
  const std::vector<scene::Body> bodies{disc(), disc("fixed"), disc()};
  const RigidDofs dofs(bodies, 0.1);
  ASSERT_EQ(dofs.size(), 6);
  Eigen::VectorXd x(6);
  x << 1, 2, 3, 4, 5, 6;
  std::vector<RigidMotion> motions(3);
  dofs.set_velocities(x, motions);
  EXPECT_EQ(dofs.velocities(motions), x);
  EXPECT_TRUE(motions[1].velocity.isZero(0));
}

TEST(RigidDofs, have_mass_and_inertia_of_the_scenes_thickness) {
  const std::vector<scene::Body> bodies{disc()};
  const RigidDofs dofs(bodies, 0.1);
  const double mass = 3 * std::numbers::pi * 0.25 * 0.1;
  EXPECT_NEAR(dofs.inertia()[0], mass, 1e-15);
  EXPECT_NEAR(dofs.inertia()[2], 0.5 * mass * 0.25, 1e-15);
}

/// Stokes' layer: a fast start drags the displaced mass along and a thin layer, a slow one drags ever more.
TEST(AddedInertia, of_a_disc_is_its_displaced_mass_at_once_and_more_with_time) {
  const double rho = 2, mu = 0.3, R = 0.1, displaced = rho * std::numbers::pi * R * R;
  const double fast = 1e-9;
  const double layer = std::sqrt(mu * fast / rho);  // δ: 4/z = 4 δ/R
  EXPECT_NEAR(added_inertia(rho, mu, R, fast, fast).mass, displaced * (1 + 4 * layer / R), 1e-6 * displaced);
  EXPECT_NEAR(added_inertia(rho, mu, R, fast, fast).inertia,
              2 * std::numbers::pi * mu * R * R * fast * (R / layer + 1.5), 1e-12);
  EXPECT_GT(added_inertia(rho, mu, R, 1, 1).mass, 10 * displaced);
}

TEST(AddedInertia, is_continuous_where_the_bessel_functions_go_over_into_their_series) {
  const double rho = 1, mu = 1, R = 50;  // z = R/√τ
  const AddedInertia below = added_inertia(rho, mu, R, 1 + 1e-9, 1),
                     above = added_inertia(rho, mu, R, 1 - 1e-9, 1);
  EXPECT_NEAR(below.mass / above.mass, 1, 1e-8);
  EXPECT_NEAR(below.inertia / above.inertia, 1, 1e-8);
  EXPECT_TRUE(std::isfinite(added_inertia(rho, mu, R, 1e-12, 1).mass));
}

TEST(PrescribedMotion, of_a_fixed_body_is_rest) {
  const scene::Body body = disc("fixed");
  const RigidMotion start = initial_motion(body);
  const RigidMotion moved = PrescribedMotion(body).advanced(start, 0, 5);
  EXPECT_EQ(moved.position, start.position);
  EXPECT_TRUE(moved.velocity.isZero(0));
}

TEST(PrescribedMotion, positions_are_the_integral_of_the_formulas) {
  scene::Body body = disc("prescribed");
  body.prescribed_velocity = {"cos(t)", "5*t^4"};
  body.prescribed_spin = "2";
  const PrescribedMotion motion(body);
  RigidMotion now = initial_motion(body);
  for (int k = 0; k < 20; ++k) now = motion.advanced(now, 0.1 * k, 0.1 * (k + 1));
  EXPECT_NEAR(now.position.x(), 1 + std::sin(2.), 1e-13);
  EXPECT_NEAR(now.position.y(), 2 + 32, 1e-12);
  EXPECT_NEAR(now.velocity.x(), std::cos(2.), 1e-14);
  EXPECT_NEAR(now.spin.z(), 2, 0);
  EXPECT_NEAR(
      now.orientation.angularDistance(Eigen::Quaterniond(Eigen::AngleAxisd(4, Eigen::Vector3d::UnitZ()))), 0,
      1e-7);
}

TEST(PrescribedMotion, a_wall_turns_about_its_axis_in_space_by_the_integral_of_its_spin) {
  scene::Wall wall;
  wall.centre = {1, 2, 3};
  wall.velocity = {"0", "0", "2*t"};
  wall.spin = {"0", "t", "0"};
  const PrescribedMotion motion(wall);
  RigidMotion now{.position = {1, 2, 3}};
  for (int k = 0; k < 20; ++k) now = motion.advanced(now, 0.1 * k, 0.1 * (k + 1));
  EXPECT_NEAR((now.position - Eigen::Vector3d(1, 2, 7)).norm(), 0, 1e-13);
  EXPECT_NEAR(
      now.orientation.angularDistance(Eigen::Quaterniond(Eigen::AngleAxisd(2, Eigen::Vector3d::UnitY()))), 0,
      1e-7);
}

/// Where a disc of this velocity along x is after 1 s in `n` steps, less what the integral is.
double error_after_a_second(const std::string& velocity, double integral, int n) {
  scene::Body body = disc("prescribed");
  body.prescribed_velocity = {velocity, "0"};
  const PrescribedMotion motion(body);
  RigidMotion now = initial_motion(body);
  for (int k = 0; k < n; ++k) now = motion.advanced(now, double(k) / n, double(k + 1) / n);
  return now.position.x() - 1 - integral;
}

TEST(PrescribedMotion, jumps_and_bends_of_the_formulas_are_integrated_whatever_the_step) {
  for (const int n : {1, 3, 10, 77}) {
    EXPECT_NEAR(error_after_a_second("t < 0.35 ? 1 : 0", 0.35, n), 0, 1e-12) << n;
    EXPECT_NEAR(error_after_a_second("t >= 0.501 && t < .502 ? 1e3 : 0", 1, n), 0, 1e-9)
        << n << ": a short pulse";
    EXPECT_NEAR(error_after_a_second("t < sqrt(1/7) ? -2 : 1", 1 - 3 * std::sqrt(1. / 7), n), 0, 1e-9) << n;
    EXPECT_NEAR(error_after_a_second(
                    "abs(t - pi/7)",
                    0.5 * (std::pow(std::numbers::pi / 7, 2) + std::pow(1 - std::numbers::pi / 7, 2)), n),
                0, 1e-9)
        << n;
    EXPECT_NEAR(error_after_a_second("rint(t*10) == 7 ? 1 : 0", 0.1, n), 0, 1e-9) << n;
    EXPECT_NEAR(error_after_a_second("sin(200*t)", (1 - std::cos(200.)) / 200, n), 0, 1e-9) << n << ": waves";
  }
}

TEST(PrescribedMotion, a_spin_of_a_wall_that_stops_turns_it_as_far_as_it_lasted) {
  scene::Wall wall;
  wall.centre = {0, 0};
  wall.spin = {"t < 0.123 ? 2 : 0"};
  const RigidMotion moved = PrescribedMotion(wall).advanced({}, 0, 1);
  EXPECT_NEAR(Eigen::AngleAxisd(moved.orientation).angle(), 0.246, 1e-12);
}

TEST(PrescribedMotion, a_step_of_no_size_only_takes_the_velocities) {
  scene::Body body = disc("prescribed");
  body.prescribed_velocity = {"0", "0"};
  body.prescribed_spin = "3";
  const RigidMotion moved = PrescribedMotion(body).advanced(initial_motion(body), 0, 0);
  EXPECT_EQ(moved.position, initial_motion(body).position);
  EXPECT_EQ(moved.spin.z(), 3);
}

TEST(TrapezoidalPosition, is_exact_for_constant_acceleration) {
  RigidMotion before;
  before.position = {1, 0, 0};
  before.velocity = {2, 0, 0};
  EXPECT_NEAR(trapezoidal_position(before, {2 - 9.81 * 0.3, 0, 0}, 0.3).x(), 1 + 2 * 0.3 - 0.5 * 9.81 * 0.09,
              1e-15);
}

}  // namespace
}  // namespace fpi::coupling
