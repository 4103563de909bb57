/// The interface that every direct solver stands behind: analyse a pattern, factor values, solve.
#pragma once

#include <memory>

#include "fluid/base/types.hpp"
#include "fluid/linear/block_matrix.hpp"

namespace fpi::fluid {

/// LU factors of a matrix; never changed once made.
class Factor {
 public:
  virtual ~Factor() = default;
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;
  /// x with A x = b. Throws Error unless b has as many entries as there are equations and the matrix is
  /// regular.
  Vector solve(const Vector& b) const;
  /// x with Aᵀ x = b; throws as `solve`.
  Vector solve_transposed(const Vector& b) const;

  bool is_singular() const { return is_singular_; }
  /// What elimination of all other unknowns leaves of the matrix for those that the analysis kept for last;
  /// without entries where it kept none.
  const Eigen::MatrixXd& schur_complement() const { return schur_complement_; }
  /// What making this factor and solving with it take: seconds on a typical core, computed from counts, so
  /// that decisions based on them are the same in every run.
  double factor_cost() const { return factor_cost_; }
  double solve_cost() const { return solve_cost_; }

 protected:
  enum class Form { plain, transposed };

  explicit Factor(Index n) : n_(n) {}
  /// With another factor, for those that are made of several; throws as `solve`.
  static Vector solve(const Factor& factor, const Vector& b, Form form) {
    return factor.checked_solve(b, form);
  }
  virtual Vector back_solve(const Vector& b, Form form) const = 0;

  Index n_;
  bool is_singular_ = false;
  Eigen::MatrixXd schur_complement_;
  double factor_cost_ = 0, solve_cost_ = 0;

 private:
  Vector checked_solve(const Vector& b, Form form) const;
};

/// The ordering of a pattern, found once and shared by all factors of it.
class Analysis {
 public:
  virtual ~Analysis() = default;
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;
  /// Factors a matrix with the pattern that was analysed. Throws Error for another pattern or where there is
  /// not enough memory; a singular matrix gives a factor with `is_singular`.
  std::shared_ptr<const Factor> factor(const BlockMatrix& matrix) const;

 protected:
  explicit Analysis(const BlockMatrix& matrix) : n_(matrix.n()), non_zeros_(matrix.non_zeros()) {}
  virtual std::shared_ptr<const Factor> make_factor(const BlockMatrix& matrix) const = 0;

 private:
  Index n_, non_zeros_;
};

}  // namespace fpi::fluid
