#include "fluid/linear/condition.hpp"

#include <limits>

namespace fpi::fluid {
namespace {

/// Calls f(row, column, |entry|) for each entry.
template <class F>
void for_each_entry(const BlockMatrix& matrix, F f) {
  for (Index c = 0; c < matrix.n(); ++c)
    for (Index k = matrix.column_start()[c]; k < matrix.column_start()[c + 1]; ++k)
      f(matrix.row()[k], c, std::abs(matrix.values()[k]));
}

/// Factors of rows and columns.
struct Scaling {
  Vector rows, columns;
};

Scaling equilibrate(const BlockMatrix& matrix) {
  constexpr int rounds = 20;  // each takes the square root of what the lengths are off from 1
  const Index n = matrix.n();
  Scaling scale{Vector::Ones(n), Vector::Ones(n)};
  for (int round = 0; round < rounds; ++round) {
    Vector row_squares = Vector::Zero(n), column_squares = Vector::Zero(n);
    for_each_entry(matrix, [&](Index i, Index j, double entry) {
      const double scaled = scale.rows[i] * entry * scale.columns[j];
      row_squares[i] += scaled * scaled;
      column_squares[j] += scaled * scaled;
    });
    scale.rows.array() /= row_squares.array().pow(0.25);
    scale.columns.array() /= column_squares.array().pow(0.25);
  }
  return scale;
}

double norm(const BlockMatrix& matrix, const Scaling& scale) {
  Vector sum = Vector::Zero(matrix.n());
  for_each_entry(matrix,
                 [&](Index i, Index j, double entry) { sum[j] += scale.rows[i] * entry * scale.columns[j]; });
  return sum.maxCoeff();
}

/// Higham's estimate: climbs from unit vector to unit vector, then tries one that no such path hides from.
double norm_of_inverse(const Factor& factor, const Scaling& scale) {
  constexpr int most_climbs = 5;
  const auto n = scale.rows.size();
  const auto inverse = [&](const Vector& x) -> Vector {
    return factor.solve(x.cwiseQuotient(scale.rows)).cwiseQuotient(scale.columns);
  };
  const auto inverse_transposed = [&](const Vector& x) -> Vector {
    return factor.solve_transposed(x.cwiseQuotient(scale.columns)).cwiseQuotient(scale.rows);
  };
  double estimate = 0;
  Vector x = Vector::Constant(n, 1.0 / static_cast<double>(n));
  for (int climb = 0; climb < most_climbs; ++climb) {
    const Vector y = inverse(x);
    if (y.lpNorm<1>() <= estimate) break;
    estimate = y.lpNorm<1>();
    const Vector slope = inverse_transposed(y.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; }));
    Eigen::Index steepest = 0;
    if (slope.cwiseAbs().maxCoeff(&steepest) <= slope.dot(x)) break;
    x = Vector::Unit(n, steepest);
  }
  Vector alternating = Vector::LinSpaced(n, 1, 2);
  for (Eigen::Index i = 1; i < n; i += 2) alternating[i] *= -1;
  return std::max(estimate, inverse(alternating).lpNorm<1>() / alternating.lpNorm<1>());
}

}  // namespace

double condition_estimate(const BlockMatrix& matrix, const Factor& factor) {
  if (factor.is_singular()) return std::numeric_limits<double>::infinity();
  const Scaling scale = equilibrate(matrix);
  return norm(matrix, scale) * norm_of_inverse(factor, scale);
}

}  // namespace fpi::fluid
