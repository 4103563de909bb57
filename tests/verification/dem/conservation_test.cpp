/// What no impact and no rotation may change.
#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::step;

TEST(Conservation, a_free_spin_about_any_axis_keeps_its_rotation_orthogonal_over_a_million_sub_steps) {
  Problem problem;
  problem.dem.largest_sub_step = 1e-6 * (1 + 1e-9);
  problem.bodies = {body("top", "sphere", 0.01, 2500, {0, 0, 0}, {0, 0, 0})};
  const Vec3 spin(3e3, -7e3, 11e3);
  problem.bodies[0].spin = {spin.x(), spin.y(), spin.z()};
  Solver solver(problem);
  EXPECT_GE(step(solver, 1).sub_steps, 999999u);
  const Eigen::Matrix3d Q = solver.motions().orientation[0].base.toRotationMatrix();
  EXPECT_LT((Q.transpose() * Q - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  // The 13 000 radians themselves are known to 1e-11 of their number.
  const Eigen::Matrix3d exact = Eigen::AngleAxisd(spin.norm(), spin.normalized()).toRotationMatrix();
  EXPECT_LT((Q - exact).cwiseAbs().maxCoeff(), 1e-11 * spin.norm());
  EXPECT_EQ(solver.motions().spin[0], spin);
}

/// Thirty spheres of several sizes that take free flight towards each other, spinning.
Problem swarm() {
  Problem problem;
  problem.materials = {material(1e7, 0.3, 0.7, 0.4, 0.05)};
  problem.materials[0].twisting_friction = 0.02;
  for (int i = 0; i < 27; ++i) {
    const Vec3 place(0.05 * (i % 3 - 1), 0.05 * (i / 3 % 3 - 1), 0.05 * (i / 9 - 1));
    const Vec3 v = -2 * place + Vec3(0.1 * (i % 2), 0.05 * (i % 4), -0.03 * (i % 5));
    problem.bodies.push_back(body("s" + std::to_string(i), "sphere", 0.012 + 0.001 * (i % 5), 2500,
                                  {place.x(), place.y(), place.z()}, {v.x(), v.y(), v.z()}));
    problem.bodies.back().spin = {10.0 * (i % 3), -5.0 * (i % 4), 3.0 * (i % 7)};
  }
  return problem;
}

TEST(Conservation, impacts_keep_linear_and_angular_momentum_to_round_off) {
  Solver solver(swarm());
  const Bodies& bodies = solver.model().bodies;
  const Motions& m = solver.motions();
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double linear_size = 0, angular_size = 0;
  const auto add = [&](double sign) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Vec3 p = bodies.mass[i] * m.velocity[i],
                 L = m.position[i].cross(p) + m.spin[i] / bodies.inverse_inertia[i];
      linear += sign * p;
      angular += sign * L;
      linear_size += p.norm();
      angular_size += L.norm();
    }
  };
  add(-1);
  std::uint64_t touched = 0;
  for (int i = 0; i < 1000; ++i) touched += step(solver, 3e-4).contacts;
  add(1);
  EXPECT_GT(touched, 20u);
  EXPECT_LT(linear.norm(), 1e-13 * linear_size);
  EXPECT_LT(angular.norm(), 1e-12 * angular_size);
}

}  // namespace
}  // namespace fpi::dem
