#include "core/expression.hpp"

#include <muParser.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "core/error.hpp"

namespace fpi {

/// The parser holds addresses of its variables, so both live on the heap together.
struct Expression::Parser {
  mu::Parser parser;
  double x = 0, y = 0, t = 0;
};

namespace {

/// Whether a = stands in it that belongs to no comparison: muParser takes it for an assignment.
bool assigns(std::string_view formula) {
  for (std::size_t i = 0; i < formula.size(); ++i) {
    const bool is_second = i > 0 && std::string_view("=<>!").find(formula[i - 1]) != std::string_view::npos;
    const bool is_first = formula.substr(i + 1).starts_with('=');
    if (formula[i] == '=' && !is_first && !is_second) return true;
  }
  return false;
}

}  // namespace

Expression::Expression(const std::string& formula, const std::string& key)
    : parser_(std::make_unique<Parser>()), formula_(formula), key_(key.empty() ? "" : key + ": ") {
  require(
      !assigns(formula),
      "a formula without = is required; got \"{}\": give the right side only, or compare with ==", formula);
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
    const int n_values = p.GetNumResults();
    require(n_values == 1,
            "a formula of one value is required; got \"{}\", a list of {}: write decimals with a point, as "
            "in 0.5",
            formula, n_values);
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
  require(
      std::isfinite(value),
      "{}the formula \"{}\" must be finite; got {} at x = {} m, y = {} m, t = {} s: give it another value "
      "there, as in t > 0 ? 1/t : 0",
      key_, formula_, value, x, y, t);
  return value;
}

}  // namespace fpi
