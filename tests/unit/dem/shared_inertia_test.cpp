/// Bodies that share their inertia with the fluid between them: a step against the balance it must close.
#include "dem/lubrication/shared_inertia.hpp"

#include <gtest/gtest.h>

#include <random>

#include "dem/base/bicgstab.hpp"
#include "grains.hpp"

namespace fpi::dem {
namespace {

using namespace test;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Matrix random_matrix(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  return Matrix::NullaryExpr(n, n, [&] { return value(random); });
}

constexpr double time_step = 0.02;

/// Three discs, the first of which runs into the second; the third is far away. The fluid takes the first
/// two along, each with its own velocity, and resists all three together.
struct ThreeDiscs : testing::Test {
  Problem problem;
  std::vector<Load> loads;
  Matrix resistance;

  ThreeDiscs() {
    problem.gravity = {0, -1, 0};
    problem.materials = {material(1e6, 0.3, 0.5, 0.4)};
    problem.bodies = {body("a", "disc", 0.1, 1000, {0, 0}, {0.3, 0}),
                      body("b", "disc", 0.1, 1500, {0.201, 0.02}, {-0.2, 0}),
                      body("c", "disc", 0.1, 800, {1, 1}, {0.1, 0.2})};
    for (std::uint32_t i = 0; i < 3; ++i)
      loads.push_back({.body = i,
                       .force = {4.0 + i, 3, 0},
                       .torque = {0, 0, 0.1 * i},
                       .velocity = {0.3 - 0.2 * i, 0.1, 0},
                       .spin = {0, 0, 0.5 * i},
                       .added_mass = 20,
                       .added_inertia = 0.2});
    // About ten times what the discs have by themselves, unsymmetric by a tenth.
    const Matrix mix = random_matrix(9, 3);
    const Vector scale = Vector::NullaryExpr(9, [](Eigen::Index k) { return k % 3 == 2 ? 0.5 : 5.0; });
    resistance = scale.asDiagonal() *
                 (mix * mix.transpose() + Matrix::Identity(9, 9) + 0.1 * random_matrix(9, 4)) *
                 scale.asDiagonal() / time_step * 10;
  }

  std::vector<double> by_rows() const {
    const auto rows = resistance.reshaped<Eigen::RowMajor>();
    return {rows.begin(), rows.end()};
  }
  static Vector velocities(const Solver& solver) {
    Vector v(9);
    for (int i = 0; i < 3; ++i)
      v.segment<3>(3 * i) << solver.motions().velocity[i].head<2>(), solver.motions().spin[i].z();
    return v;
  }
  /// The mean force and torque of contacts and films in the step, by the balance of all bodies: those that
  /// the fluid's velocities V go with, m (V − v_n)/Δt − F − m g, and what the change from V takes.
  Vector between_bodies(const Solver& solver) const {
    Vector V(9), expected(9);
    for (int i = 0; i < 3; ++i) {
      const Load& load = loads[i];
      const Bodies& bodies = solver.model().bodies;
      const scene::Body& start = problem.bodies[i];
      V.segment<3>(3 * i) << load.velocity.head<2>(), load.spin.z();
      const Vec3 gained = load.velocity - Vec3(start.velocity[0], start.velocity[1], 0);
      expected.segment<2>(3 * i) =
          (bodies.mass[i] * (gained / time_step - problem.gravity) - load.force).head<2>();
      expected[3 * i + 2] = bodies.inertia[i] * load.spin.z() / time_step - load.torque.z();
    }
    return expected + resistance * (velocities(solver) - V);
  }
};

TEST_F(ThreeDiscs, without_contact_take_what_the_fluid_found_and_nothing_else) {
  problem.bodies[1].position[0] = 0.5;
  Solver solver(problem);
  ASSERT_TRUE(solver.advance(time_step, loads, {}, {}, {}, by_rows()).converged);
  EXPECT_LT(between_bodies(solver).norm(), 1e-9);
}

TEST_F(ThreeDiscs, that_touch_push_each_other_alike_and_nobody_else) {
  Solver solver(problem);
  const Advanced outcome = solver.advance(time_step, loads, {}, {}, {}, by_rows());
  ASSERT_TRUE(outcome.converged);
  EXPECT_GT(outcome.contacts, 0u);
  const Vector force = between_bodies(solver);
  EXPECT_LT(force[0], -1);
  EXPECT_LT((force.segment<2>(0) + force.segment<2>(3)).norm(), 1e-9 * force.norm());
  EXPECT_NEAR(force[2], force[5], 1e-9 * force.norm());  // friction turns both the same way
  EXPECT_LT(force.tail<3>().norm(), 1e-9 * force.norm());
}

TEST_F(ThreeDiscs, with_a_stiff_film_between_them_end_as_its_implicit_equations_say) {
  problem.bodies[1].position = {0.2002, 0};
  problem.dem.lubrication.viscosity = 100;
  const std::vector<double> resolved(3, 0.05);
  problem.dem.largest_sub_step = time_step;
  Solver solver(problem);
  const Advanced outcome = solver.advance(time_step, loads, {}, resolved, {}, by_rows());
  ASSERT_TRUE(outcome.converged);
  EXPECT_EQ(outcome.contacts, 0u);
  const Vector force = between_bodies(solver), v = velocities(solver);
  EXPECT_LT((force.segment<2>(0) + force.segment<2>(3)).norm(), 1e-6 * force.norm());
  EXPECT_LT(force.tail<3>().norm(), 1e-6 * force.norm());
  EXPECT_LT(force[0], -1);
  EXPECT_LT(std::abs(v[0] - v[3]), 0.02);  // of an approach with 0.5 m/s
}

TEST_F(ThreeDiscs, do_not_turn_in_a_film_where_they_must_not) {
  problem.dem.lubrication.viscosity = 1;
  problem.bodies[1].rotates = false;
  const std::vector<double> resolved(3, 0.05);
  Solver solver(problem);
  ASSERT_TRUE(solver.advance(time_step, loads, {}, resolved, {}, by_rows()).converged);
  EXPECT_EQ(solver.motions().spin[1].norm(), 0);
  EXPECT_TRUE(velocities(solver).allFinite());
}

TEST_F(ThreeDiscs, each_by_itself_do_as_with_added_inertia) {
  problem.dem.lubrication.viscosity = 1;
  const std::vector<double> resolved(3, 0.05);
  Solver one(problem), other(problem);
  resistance.setZero();
  for (int i = 0; i < 3; ++i) {
    const double mass = one.model().bodies.mass[i] + 20, inertia = one.model().bodies.inertia[i] + 0.2;
    resistance.diagonal().segment<3>(3 * i) << mass / time_step, mass / time_step, inertia / time_step;
  }
  ASSERT_TRUE(one.advance(time_step, loads, {}, resolved).converged);
  ASSERT_TRUE(other.advance(time_step, loads, {}, resolved, {}, by_rows()).converged);
  EXPECT_LT((velocities(one) - velocities(other)).norm(), 1e-9);
}

TEST_F(ThreeDiscs, take_a_resistance_of_nine_rows_and_columns_only) {
  Solver solver(problem);
  EXPECT_THROW(solver.advance(time_step, loads, {}, {}, {}, std::vector<double>(80)), Error);
  EXPECT_THROW(solver.advance(time_step, loads, {}, {}, {}, std::vector<double>(81, std::nan(""))), Error);
}

TEST(BiCgStab, solves_unsymmetric_systems_to_the_tolerance) {
  const Matrix A = random_matrix(40, 1) + 12 * Matrix::Identity(40, 40);
  const Vector x = Vector::LinSpaced(40, -1, 2), b = A * x;
  const auto found =
      bicgstab([&](const Vector& y) -> Vector { return A * y; },
               [&](const Vector& y) -> Vector { return y.cwiseQuotient(A.diagonal()); }, b, 1e-12, 100);
  EXPECT_LT((found - x).norm(), 1e-9);
  EXPECT_EQ(bicgstab([&](const Vector& y) -> Vector { return A * y; }, [](const Vector& y) { return y; },
                     Vector::Zero(40), 1e-12, 100),
            Vector::Zero(40));
}

}  // namespace
}  // namespace fpi::dem
