#include "fluid/linear/anderson.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace fpi::fluid {
namespace {

/// x ← x + δ(x) with δ(x) = b − A x, where A is near the identity: one correction alone shrinks by about 0.6.
struct Problem {
  static constexpr int n = 8;
  Eigen::MatrixXd a;
  Vector b = Vector::Ones(n);
  Problem() {
    std::srand(4);
    a = Eigen::MatrixXd::Identity(n, n) + 0.25 * Eigen::MatrixXd::Random(n, n);
  }
  double residual_after(int steps, bool accelerated) const {
    Anderson anderson;
    Vector x = Vector::Zero(n);
    for (int k = 0; k < steps; ++k) {
      const Vector correction = b - a * x;
      x += accelerated ? anderson.step(correction, Vector::Ones(n)) : correction;
    }
    return (b - a * x).norm();
  }
};

TEST(Anderson, solves_a_linear_problem_in_as_many_steps_as_it_has_unknowns) {
  const Problem problem;
  EXPECT_GT(problem.residual_after(Problem::n + 1, false), 1e-3);
  EXPECT_LT(problem.residual_after(Problem::n + 1, true), 1e-9);
}

TEST(Anderson, takes_the_plain_correction_first_and_after_it_was_cleared) {
  Anderson anderson;
  const Vector one = Vector::Ones(3), two = Vector::Constant(3, 2.0) + Vector::Unit(3, 0);
  EXPECT_EQ(anderson.step(one, one), one);
  EXPECT_NE(anderson.step(two, one), two);
  anderson.clear();
  EXPECT_EQ(anderson.step(two, one), two);
}

TEST(Anderson, corrections_that_do_not_change_do_no_harm) {
  Anderson anderson;
  const Vector one = Vector::Ones(3);
  for (int k = 0; k < 20; ++k) EXPECT_TRUE(anderson.step(one, one).allFinite());
}

}  // namespace
}  // namespace fpi::fluid
