#include "fluid/linear/bordered_factor.hpp"

#include <Eigen/LU>
#include <utility>

namespace fpi::fluid {
namespace {

class BorderedFactor : public Factor {
 public:
  BorderedFactor(std::shared_ptr<const Factor> inner, const Columns& columns, const Columns& rows)
      : Factor(static_cast<Index>(columns.rows() + columns.cols())),
        inner_(std::move(inner)),
        columns_(columns),
        rows_(rows) {
    is_singular_ = inner_->is_singular();
    const auto border = static_cast<double>(columns.cols());
    factor_cost_ = inner_->factor_cost() + border * inner_->solve_cost();
    solve_cost_ = inner_->solve_cost();
    if (is_singular_) return;
    solved_ = solved(columns_, Form::plain);
    is_singular_ = !Eigen::FullPivLU<Columns>(rows_.transpose() * solved_).isInvertible();
  }

 private:
  /// With x = A⁻¹(b − columns · a), the last rows say rowsᵀ A⁻¹ columns · a = rowsᵀ A⁻¹ b − given.
  Vector back_solve(const Vector& b, Form form) const override {
    const bool plain = form == Form::plain;
    const Columns& rows = plain ? rows_ : columns_;
    const Columns columns = plain ? solved_ : solved(rows_, form);
    const Eigen::Index n = columns.rows(), border = columns.cols();
    Vector out(n + border);
    out.head(n) = solved(b.head(n), form);
    out.tail(border) =
        (rows.transpose() * columns).fullPivLu().solve(rows.transpose() * out.head(n) - b.tail(border));
    out.head(n) -= columns * out.tail(border);
    return out;
  }

  /// A⁻¹ b or A⁻ᵀ b, column by column.
  Columns solved(const Columns& b, Form form) const {
    Columns out(b.rows(), b.cols());
    for (Eigen::Index k = 0; k < b.cols(); ++k) out.col(k) = solve(*inner_, b.col(k), form);
    return out;
  }

  std::shared_ptr<const Factor> inner_;
  Columns columns_, rows_;
  Columns solved_;  // A⁻¹ columns
};

}  // namespace

std::shared_ptr<const Factor> with_border(std::shared_ptr<const Factor> inner, const Columns& columns,
                                          const Columns& rows) {
  return std::make_shared<BorderedFactor>(std::move(inner), columns, rows);
}

}  // namespace fpi::fluid
