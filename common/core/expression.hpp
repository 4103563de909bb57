/// Formulas of the scene in x, y [m] and t [s], such as "4*0.3*y*(0.41-y)/0.41^2". muParser stays in the
/// source.
#pragma once

#include <memory>
#include <string>

namespace fpi {

class Expression {
 public:
  /// Throws Error naming the formula and the place in it that cannot be read. `key` says where it stands in
  /// the scene.
  explicit Expression(const std::string& formula, const std::string& key = "");
  explicit Expression(double constant);
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  /// Value at (x, y, t). Throws Error with key, formula and x, y, t when it is not finite.
  double operator()(double x, double y, double t) const;

  /// False where the formula does not name t at all.
  bool depends_on_time() const { return depends_on_time_; }
  /// True where the formula is the constant 0.
  bool is_zero() const { return is_zero_; }
  const std::string& formula() const { return formula_; }

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::string formula_, key_;
  bool depends_on_time_ = false;
  bool is_zero_ = false;
};

}  // namespace fpi
