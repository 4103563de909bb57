#include "core/expression.hpp"

#include <muParser.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace fpi {

/// The parser holds addresses of its variables, so both live on the heap together.
struct Expression::Parser {
  mu::Parser parser;
  double x = 0, y = 0, t = 0;
};

Expression::Expression(const std::string& formula) : parser_(std::make_unique<Parser>()), formula_(formula) {
  try {
    mu::Parser& p = parser_->parser;
    p.DefineVar("x", &parser_->x);
    p.DefineVar("y", &parser_->y);
    p.DefineVar("t", &parser_->t);
    p.DefineConst("pi", std::numbers::pi);
    p.SetExpr(formula);
    const auto& used = p.GetUsedVar();
    depends_on_time_ = used.contains("t");
    const double value = p.Eval();
    is_zero_ = used.empty() && value == 0;
  } catch (const mu::Parser::exception_type& e) {
    fail(
        "a formula in x, y, t and pi is required (operators + - * / ^, functions such as sin, exp, sqrt); "
        "got \"{}\": {}",
        formula, e.GetMsg());
  }
}

Expression::Expression(double constant) : Expression(fmt::format("{:.17g}", constant)) {}
Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

double Expression::operator()(double x, double y, double t) const {
  parser_->x = x;
  parser_->y = y;
  parser_->t = t;
  const double value = parser_->parser.Eval();
  require(std::isfinite(value), "the formula \"{}\" must be finite; got {} at x = {}, y = {}, t = {}",
          formula_, value, x, y, t);
  return value;
}

}  // namespace fpi
