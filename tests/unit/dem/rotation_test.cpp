#include "dem/base/rotation.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace fpi::dem {
namespace {

const Vec3 theta_1(0.3, -0.8, 0.5), theta_2(-0.6, 0.2, 0.9);

Eigen::Matrix3d exact(const Vec3& theta) {
  return Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix();
}

TEST(Rotation, matrix_of_alpha_is_the_rotation_by_theta) {
  for (const double size : {1e-9, 1e-3, 0.1, 1.0, 3.0, 5.0}) {
    const Vec3 theta = size * Vec3(1, 2, -2) / 3;
    EXPECT_LT((matrix(rescaled(theta)) - exact(theta)).norm(), 1e-14) << size;
  }
}

TEST(Rotation, matrix_is_orthogonal) {
  const Eigen::Matrix3d Q = matrix(rescaled(theta_1));
  EXPECT_LT((Q.transpose() * Q - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_NEAR(Q.determinant(), 1, 1e-15);
}

TEST(Rotation, composition_is_the_second_matrix_times_the_first) {
  const Vec3 a1 = rescaled(theta_1), a2 = rescaled(theta_2);
  EXPECT_LT((matrix(compose(a1, a2)) - matrix(a2) * matrix(a1)).norm(), 1e-15);
  EXPECT_GT((matrix(compose(a1, a2)) - matrix(a1) * matrix(a2)).norm(), 0.1);
}

TEST(Rotation, quaternion_and_matrix_of_alpha_agree) {
  const Vec3 a = rescaled(theta_1);
  EXPECT_LT((quaternion(a).toRotationMatrix() - matrix(a)).norm(), 1e-15);
}

TEST(Rotation, series_meets_the_tangent) {
  const Vec3 axis(1, 0, 0);
  const double below = rescaled(0.0199999 * axis).x(), above = rescaled(0.0200001 * axis).x();
  EXPECT_NEAR(below / (2 * std::tan(0.0199999 / 2)), 1, 1e-15);
  EXPECT_NEAR(above / (2 * std::tan(0.0200001 / 2)), 1, 1e-15);
}

TEST(Rotation, a_million_small_turns_keep_the_rotation_exact) {
  constexpr int n = 1'000'000;
  const Vec3 total(40, -25, 31);
  Orientation orientation;
  for (int i = 0; i < n; ++i) orientation.turn(total / n);
  orientation.settle();
  const Eigen::Matrix3d Q = orientation.base.toRotationMatrix();
  EXPECT_LT((Q.transpose() * Q - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((Q - exact(total)).norm(), 1e-9);
}

TEST(Rotation, a_turn_through_pi_is_no_singularity) {
  Orientation orientation;
  for (const double angle : {std::numbers::pi, 2.0, 3.0}) orientation.turn({0, 0, angle});
  orientation.settle();
  EXPECT_LT((orientation.base.toRotationMatrix() - exact({0, 0, std::numbers::pi + 5})).norm(), 1e-14);
}

}  // namespace
}  // namespace fpi::dem
