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

TEST(Expression, a_list_or_an_assignment_is_no_formula_and_gets_a_hint) {
  for (const char* list : {"0,5", "1,2,3", "x, y", "t > 1 ? 0,5 : 1"})
    EXPECT_NE(error_of(list).find("formula"), std::string::npos) << list;
  EXPECT_NE(error_of("0,5").find("write decimals with a point, as in 0.5"), std::string::npos)
      << error_of("0,5");
  for (const char* assignment : {"x=5", "x = 5", "t=x", "1 + (y=2)", "x==y=1"})
    EXPECT_NE(error_of(assignment).find("compare with =="), std::string::npos) << error_of(assignment);
}

TEST(Expression, comparisons_and_functions_of_several_values_stay_formulas) {
  EXPECT_EQ(Expression("(x == 2) + (y != 2) + (t <= 2) + (t >= 2)")(2, 2, 2), 3);
  EXPECT_EQ(Expression("min(0,5) + max(x, y)")(2, 3, 0), 3);
}

TEST(Expression, names_its_key_where_it_is_not_finite) {
  try {
    Expression("1/(t-x)", "fluid.body_force.0")(2, 3, 2);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(
        e.what(),
        "fluid.body_force.0: the formula \"1/(t-x)\" must be finite; got inf at x = 2 m, y = 3 m, t = 2 s: "
        "give it another value there, as in t > 0 ? 1/t : 0");
  }
}

TEST(Expression, refuses_a_value_that_is_not_finite_and_says_where) {
  EXPECT_NE(error_of("1/x").find("must be finite; got inf at x = 0 m, y = 0 m, t = 0 s"), std::string::npos);
  EXPECT_EQ(Expression("1/x")(2, 0, 0), 0.5);
}

}  // namespace
}  // namespace fpi
