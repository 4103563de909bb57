#include "fluid/linear/factor.hpp"

#include "core/error.hpp"

namespace fpi::fluid {

Vector Factor::solve(const Vector& b) const { return checked_solve(b, Form::plain); }

Vector Factor::solve_transposed(const Vector& b) const { return checked_solve(b, Form::transposed); }

Vector Factor::checked_solve(const Vector& b, Form form) const {
  require(!is_singular_, "a regular matrix is required to solve with; this one is singular");
  require(b.size() == n_, "a right-hand side of {} entries is required; got {}", n_, b.size());
  return back_solve(b, form);
}

std::shared_ptr<const Factor> Analysis::factor(const BlockMatrix& matrix) const {
  require(
      matrix.n() == n_ && matrix.non_zeros() == non_zeros_,
      "the matrix that was analysed is required ({} unknowns, {} entries); got {} and {}: analyse it anew",
      n_, non_zeros_, matrix.n(), matrix.non_zeros());
  return make_factor(matrix);
}

}  // namespace fpi::fluid
