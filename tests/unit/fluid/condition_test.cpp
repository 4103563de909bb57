#include "fluid/linear/condition.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace fpi::fluid {
namespace {

/// Of a small dense matrix.
double estimate(const Eigen::MatrixXd& dense) {
  const auto n = static_cast<int>(dense.rows());
  const BlockMask mask = BlockMask::dense(n);
  BlockMatrix matrix(n);
  std::vector<Index> equations;
  for (Index i = 0; i < n; ++i) equations.push_back(i);
  matrix.declare(equations, mask);
  matrix.finish();
  matrix.add(0, dense.data());
  return condition_estimate(matrix, *analyse(matrix, "umfpack")->factor(matrix));
}

double norm(const Eigen::MatrixXd& m) { return m.cwiseAbs().colwise().sum().maxCoeff(); }

TEST(Condition, is_1_for_a_diagonal_of_any_magnitudes) {
  const Eigen::MatrixXd m = Eigen::Vector4d(1e-12, 3, -7e5, 1e20).asDiagonal();
  EXPECT_NEAR(estimate(m), 1, 1e-9);
}

TEST(Condition, is_4_over_the_distance_of_two_equations_that_are_nearly_one) {
  for (const double distance : {1e-3, 1e-6, 1e-9}) {
    Eigen::Matrix2d m;
    m << 1, 1, 1, 1 + distance;
    EXPECT_NEAR(estimate(m) * distance, 4, 0.01);
  }
}

TEST(Condition, is_infinite_for_a_singular_matrix) {
  EXPECT_EQ(estimate(Eigen::Matrix2d::Ones()), std::numeric_limits<double>::infinity());
}

TEST(Condition, of_random_matrices_is_that_of_the_dense_inverse_within_a_factor_of_3_and_knows_no_units) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int trial = 0; trial < 10; ++trial) {
    Eigen::MatrixXd m = Eigen::MatrixXd::NullaryExpr(40, 40, [&] { return value(random); });
    const double exact = norm(m) * norm(m.inverse());  // rows and columns are nearly of the same length
    const double found = estimate(m);
    EXPECT_LT(found, 3 * exact);
    EXPECT_GT(found, exact / 3);
    Eigen::VectorXd units(40);
    for (double& unit : units) unit = std::exp2(std::round(20 * value(random)));
    EXPECT_NEAR(estimate(units.asDiagonal() * m * units.reverse().asDiagonal()), found, 0.01 * found);
  }
}

}  // namespace
}  // namespace fpi::fluid
