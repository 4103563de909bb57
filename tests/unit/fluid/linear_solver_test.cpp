#include "fluid/linear/linear_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "fluid/linear/bordered_factor.hpp"

namespace fpi::fluid {
namespace {

/// A chain of overlapping random elements, like those of the fluid: four velocities (convected, so
/// unsymmetric) and one pressure with a zero on the diagonal each. `dense` is the same matrix.
struct SaddlePoint {
  static constexpr Index n_elements = 100, n_velocities = 2 * n_elements + 2;
  static constexpr Index n = n_velocities + n_elements;
  static constexpr int size = 5;
  BlockMask mask = BlockMask::dense(size);
  BlockMatrix matrix{n};
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);

  explicit SaddlePoint(unsigned seed = 7) {
    for (Index e = 0; e < n_elements; ++e) matrix.declare(equations(e), mask);
    matrix.finish();
    fill(seed);
  }
  static std::array<Index, size> equations(Index e) {
    return {2 * e, 2 * e + 1, 2 * e + 2, 2 * e + 3, n_velocities + e};
  }
  void fill(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    matrix.set_zero();
    dense.setZero();
    for (Index e = 0; e < n_elements; ++e) {
      Eigen::Matrix<double, size, size> block;
      for (double& x : block.reshaped()) x = value(random);
      block.diagonal().array() += 6;
      block.row(size - 1) = block.col(size - 1).transpose();
      block(size - 1, size - 1) = 0;
      matrix.add(e, block.data());
      const auto at = equations(e);
      for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) dense(at[i], at[j]) += block(i, j);
    }
  }
};

struct DirectSolver : testing::TestWithParam<std::string_view> {
  static std::shared_ptr<const Analysis> analysis(const BlockMatrix& matrix) {
    return analyse(matrix, GetParam());
  }
  const Vector x = Vector::LinSpaced(SaddlePoint::n, -1, 2);
};

TEST_P(DirectSolver, solves_saddle_point_systems_to_round_off) {
  for (const unsigned seed : {1, 2, 3}) {
    const SaddlePoint system(seed);
    const auto factor = analysis(system.matrix)->factor(system.matrix);
    ASSERT_FALSE(factor->is_singular());
    EXPECT_LT((factor->solve(system.dense * x) - x).norm(), 1e-9);
  }
}

/// So many unknowns that UMFPACK is called with 64-bit integers: a chain of springs.
TEST_P(DirectSolver, solves_more_unknowns_than_are_counted_in_32_bits) {
  constexpr Index n = 410000;
  const BlockMask mask = BlockMask::dense(2);
  BlockMatrix chain{n};
  for (Index e = 0; e + 1 < n; ++e) chain.declare(std::array<Index, 2>{e, e + 1}, mask);
  chain.finish();
  chain.set_zero();
  const std::array<double, 4> spring{2, -1, -1, 2};
  for (Index e = 0; e + 1 < n; ++e) chain.add(e, spring.data());
  const Vector wanted = Vector::LinSpaced(n, -1, 2).array().sin();
  Vector b = 4 * wanted;
  b[0] -= 2 * wanted[0];
  b[n - 1] -= 2 * wanted[n - 1];
  b.head(n - 1) -= wanted.tail(n - 1);
  b.tail(n - 1) -= wanted.head(n - 1);
  const auto factor = analysis(chain)->factor(chain);
  EXPECT_LT((factor->solve(b) - wanted).lpNorm<Eigen::Infinity>(), 1e-12);
  EXPECT_LT((factor->solve_transposed(b) - wanted).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST_P(DirectSolver, solves_the_transposed_system_with_the_same_factor) {
  const SaddlePoint system;
  const auto factor = analysis(system.matrix)->factor(system.matrix);
  EXPECT_LT((factor->solve_transposed(system.dense.transpose() * x) - x).norm(), 1e-9);
  EXPECT_LT((factor->solve(system.dense * x) - x).norm(), 1e-9);
}

TEST_P(DirectSolver, keeps_each_factor_when_the_matrix_changes_and_others_are_made) {
  SaddlePoint system(1);
  const Eigen::MatrixXd first = system.dense;
  const auto analysed = analysis(system.matrix);
  const auto factor = analysed->factor(system.matrix);
  system.fill(2);
  const auto other = analysed->factor(system.matrix);
  EXPECT_LT((factor->solve(first * x) - x).norm(), 1e-9);
  EXPECT_LT((other->solve(system.dense * x) - x).norm(), 1e-9);
}

TEST_P(DirectSolver, gives_bitwise_the_same_whatever_was_factored_before) {
  SaddlePoint system(1);
  const auto analysed = analysis(system.matrix);
  const Vector b = system.dense * x;
  const auto held = analysed->factor(system.matrix);
  const Vector first = held->solve(b);
  system.fill(2);
  analysed->factor(system.matrix);  // not kept
  system.fill(1);
  EXPECT_EQ(analysed->factor(system.matrix)->solve(b), first);
  EXPECT_EQ(analysis(system.matrix)->factor(system.matrix)->solve(b), first);
}

TEST_P(DirectSolver, serves_factors_that_outlive_their_analysis) {
  const SaddlePoint system;
  std::shared_ptr<const Factor> factor = analysis(system.matrix)->factor(system.matrix);
  EXPECT_LT((factor->solve(system.dense * x) - x).norm(), 1e-9);
}

TEST_P(DirectSolver, says_when_a_matrix_is_singular_and_factors_the_next_one) {
  SaddlePoint system;
  const auto analysed = analysis(system.matrix);
  system.matrix.set_zero();
  const auto singular = analysed->factor(system.matrix);
  EXPECT_TRUE(singular->is_singular());
  EXPECT_THROW(singular->solve(x), Error);
  system.fill(3);
  EXPECT_LT((analysed->factor(system.matrix)->solve(system.dense * x) - x).norm(), 1e-9);
}

TEST_P(DirectSolver, ends_for_values_that_are_not_finite) {
  SaddlePoint system;
  Eigen::Matrix<double, SaddlePoint::size, SaddlePoint::size> block;
  block.setConstant(std::numeric_limits<double>::quiet_NaN());
  system.matrix.add(3, block.data());
  const auto factor = analysis(system.matrix)->factor(system.matrix);
  EXPECT_TRUE(factor->is_singular() || !factor->solve(x).allFinite());
}

TEST_P(DirectSolver, refuses_a_matrix_without_unknowns) {
  BlockMatrix empty(0);
  empty.finish();
  EXPECT_THROW(analysis(empty), Error);
}

TEST_P(DirectSolver, refuses_what_does_not_fit) {
  const SaddlePoint system;
  const auto analysed = analysis(system.matrix);
  BlockMatrix other(SaddlePoint::n);
  other.declare(SaddlePoint::equations(0), system.mask);
  other.finish();
  EXPECT_THROW(analysed->factor(other), Error);
  EXPECT_THROW(analysed->factor(system.matrix)->solve(x.head(3)), Error);
}

TEST_P(DirectSolver, counts_the_same_cost_each_time_and_more_for_a_factor_than_for_a_solve) {
  const SaddlePoint system;
  const auto analysed = analysis(system.matrix);
  const auto factor = analysed->factor(system.matrix);
  EXPECT_GT(factor->solve_cost(), 0);
  EXPECT_GT(factor->factor_cost(), factor->solve_cost());
  const auto again = analysed->factor(system.matrix);
  EXPECT_EQ(again->factor_cost(), factor->factor_cost());
  EXPECT_EQ(again->solve_cost(), factor->solve_cost());
}

TEST_P(DirectSolver, solves_alike_and_gives_the_schur_complement_of_unknowns_kept_for_last) {
  if (!gives_schur_complements(GetParam())) GTEST_SKIP() << GetParam() << " gives none";
  const SaddlePoint system;
  const std::vector<Index> last{17, 3, 42};
  const auto factor = analyse(system.matrix, GetParam(), {}, last)->factor(system.matrix);
  EXPECT_LT((factor->solve(system.dense * x) - x).norm(), 1e-9);
  EXPECT_LT((factor->solve_transposed(system.dense.transpose() * x) - x).norm(), 1e-9);
  const Eigen::MatrixXd inverse = system.dense.inverse();
  const Eigen::MatrixXd of_last = inverse(last, last).inverse();
  EXPECT_LT((factor->schur_complement() - of_last).norm(), 1e-9 * of_last.norm());
}

INSTANTIATE_TEST_SUITE_P(Backends, DirectSolver, testing::ValuesIn(linear_solvers()),
                         [](const auto& backend) { return std::string(backend.param); });

TEST(LinearSolver, refuses_a_solver_that_the_build_lacks_naming_those_it_has) {
  const SaddlePoint system;
  try {
    analyse(system.matrix, "pardiso");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("(umfpack"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("\"pardiso\""), std::string::npos) << error.what();
  }
}

TEST(BorderedFactor, solves_with_dense_rows_and_columns_around_the_matrix) {
  const SaddlePoint system;
  constexpr Index n = SaddlePoint::n, border = 2;
  const Columns columns = Columns::Random(n, border), rows = Columns::Random(n, border);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + border, n + border);
  whole.topLeftCorner<n, n>() = system.dense;
  whole.topRightCorner<n, border>() = columns;
  whole.bottomLeftCorner<border, n>() = rows.transpose();
  const auto inner = analyse(system.matrix, linear_solvers().front())->factor(system.matrix);
  const auto factor = with_border(inner, columns, rows);
  const Vector b = Vector::Random(n + border);
  EXPECT_LT((whole * factor->solve(b) - b).norm(), 1e-10 * b.norm());
  EXPECT_LT((whole.transpose() * factor->solve_transposed(b) - b).norm(), 1e-10 * b.norm());
  EXPECT_TRUE(with_border(inner, columns, Columns::Zero(n, border))->is_singular());
}

}  // namespace
}  // namespace fpi::fluid
