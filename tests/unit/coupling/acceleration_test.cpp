/// Relaxation factors.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "coupling/aitken.hpp"
#include "coupling/constant_relaxation.hpp"

namespace fpi::coupling {
namespace {

TEST(Aitken, finds_the_secant_of_a_scalar_map) {
  // H(x) = −3 x: r(x) = −4 x, zero after the factor 1/4.
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 2), r = -4 * x;
  Aitken aitken(0.5);
  aitken.begin_step();
  const Eigen::VectorXd next = aitken.next(x, r);
  EXPECT_DOUBLE_EQ(next[0], -2);
  EXPECT_NEAR(aitken.next(next, -4 * next)[0], 0, 1e-15);
  EXPECT_DOUBLE_EQ(aitken.factor(), 0.25);
}

TEST(Aitken, keeps_its_factor_where_residuals_do_not_change) {
  const Eigen::VectorXd r = Eigen::Vector2d(1, 2);
  EXPECT_EQ(aitken_factor(0.3, r, r), 0.3);
  EXPECT_EQ(aitken_factor(0.3, Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()), 0.3);
  EXPECT_EQ(aitken_factor(0.3, Eigen::Vector2d(1e200, 0), Eigen::Vector2d(-1e200, 0)), 0.3);  // overflow
}

TEST(Aitken, clamps_its_factor) {
  const Eigen::VectorXd r = Eigen::VectorXd::Constant(1, 1);
  EXPECT_EQ(aitken_factor(0.5, r, 0.999 * r), Aitken::largest);
  EXPECT_EQ(aitken_factor(0.5, r, 2 * r), Aitken::smallest);
  EXPECT_EQ(aitken_factor(0.5, r, -1e6 * r), Aitken::smallest);
}

TEST(Aitken, starts_a_step_with_the_last_factor_and_a_rejected_one_with_the_first) {
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 2);
  Aitken aitken(0.5);
  aitken.next(x, -4 * x);
  aitken.next(-x, 4 * x);
  aitken.accept();
  aitken.begin_step();
  EXPECT_DOUBLE_EQ(aitken.next(x, x)[0], 2.5);
  aitken.reject();
  aitken.begin_step();
  EXPECT_DOUBLE_EQ(aitken.next(x, x)[0], 3);
}

TEST(Aitken, state_restores_the_next_step_to_the_bit) {
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 2);
  Aitken aitken(0.5), other(0.5);
  aitken.next(x, -4.1 * x);
  aitken.next(-x, 3.7 * x);
  other.set_state(aitken.state());
  aitken.begin_step();
  EXPECT_EQ(aitken.next(x, x), other.next(x, x));
}

TEST(Relaxation, factors_outside_their_range_are_refused_with_their_value) {
  EXPECT_THROW(ConstantRelaxation(0), Error);
  EXPECT_THROW(Aitken(-1), Error);
  try {
    Aitken(2.5);
    FAIL() << "it was taken";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("got 2.5"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace fpi::coupling
