/// Formulas of a scene.
#include "core/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace fpi {
namespace {

std::string error_of(const std::string& formula) {
  try {
    const Expression expression(formula);
    expression(0, 0, 0);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Expression, is_a_function_of_x_y_and_t) {
  const Expression inlet("4*0.3*y*(0.41-y)/0.41^2*sin(pi*t/8)");
  EXPECT_DOUBLE_EQ(inlet(7, 0.1, 4), 4 * 0.3 * 0.1 * 0.31 / (0.41 * 0.41) * std::sin(std::numbers::pi / 2));
  EXPECT_DOUBLE_EQ(Expression("x-y")(3, 1, 0), 2);
}

TEST(Expression, keeps_every_bit_of_a_constant) { EXPECT_EQ(Expression(0.1 + 0.2)(1, 2, 3), 0.1 + 0.2); }

TEST(Expression, knows_whether_it_depends_on_time_and_whether_it_is_zero) {
  EXPECT_TRUE(Expression("x*t").depends_on_time());
  EXPECT_FALSE(Expression("tan(x)").depends_on_time());
  EXPECT_TRUE(Expression("0").is_zero());
  EXPECT_TRUE(Expression(0.0).is_zero());
  EXPECT_FALSE(Expression("x").is_zero());
}

TEST(Expression, keeps_working_after_a_move) {
  Expression from("x+1");
  Expression to = std::move(from);
  EXPECT_EQ(to(2, 0, 0), 3);
}

TEST(Expression, names_a_formula_that_cannot_be_read) {
  EXPECT_NE(error_of("4*z").find("got \"4*z\""), std::string::npos);
  EXPECT_NE(error_of("4*z").find("\"z\""), std::string::npos);
  EXPECT_NE(error_of("(1").find("a formula in x, y, t and pi is required"), std::string::npos);
  EXPECT_NE(error_of("").find("formula"), std::string::npos);
}

TEST(Expression, refuses_a_value_that_is_not_finite_and_says_where) {
  EXPECT_NE(error_of("1/x").find("must be finite; got inf at x = 0, y = 0, t = 0"), std::string::npos);
  EXPECT_EQ(Expression("1/x")(2, 0, 0), 0.5);
}

}  // namespace
}  // namespace fpi
