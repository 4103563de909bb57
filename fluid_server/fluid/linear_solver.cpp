#include "fluid/linear_solver.hpp"

#include <umfpack.h>

#include <array>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

using Control = std::array<double, UMFPACK_CONTROL>;
using Info = std::array<double, UMFPACK_INFO>;

/// numerics.md section 3: the pattern is symmetric; the default pivot tolerance fills in from the
/// multipliers' pivots; iterative refinement is left to the outer iteration. From some 200 000 unknowns
/// nested dissection pays.
Control control_for(Index n) {
  Control control;
  umfpack_di_defaults(control.data());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_ORDERING] = n < 200000 ? UMFPACK_ORDERING_AMD : UMFPACK_ORDERING_METIS;
  control[UMFPACK_PIVOT_TOLERANCE] = 1e-3;
  control[UMFPACK_IRSTEP] = 0;
  return control;
}

void check(int status, const char* phase, Index n) {
  require(status != UMFPACK_ERROR_out_of_memory,
          "the {} of {} unknowns needs more memory than there is: take a coarser mesh or a larger machine",
          phase, n);
  require(status >= UMFPACK_OK, "the {} of {} unknowns failed: UMFPACK status {}; please report it", phase, n,
          status);
}

}  // namespace

Analysis::Analysis(const BlockMatrix& matrix) {
  const Control control = control_for(matrix.n());
  Info info;
  const int status =
      umfpack_di_symbolic(matrix.n(), matrix.n(), matrix.column_start().data(), matrix.row().data(), nullptr,
                          &symbolic_, control.data(), info.data());
  check(status, "analysis", matrix.n());
}

Analysis::~Analysis() { umfpack_di_free_symbolic(&symbolic_); }

Factor::Factor(std::shared_ptr<const Analysis> analysis, const BlockMatrix& matrix)
    : analysis_(std::move(analysis)), n_(matrix.n()) {
  const Control control = control_for(n_);
  Info info;
  const int status = umfpack_di_numeric(matrix.column_start().data(), matrix.row().data(), matrix.values(),
                                        analysis_->handle(), &numeric_, control.data(), info.data());
  is_singular_ = status == UMFPACK_WARNING_singular_matrix;
  check(status, "factorisation", n_);
}

Factor::~Factor() { umfpack_di_free_numeric(&numeric_); }

Vector Factor::solve(const Vector& b) const {
  const Control control = control_for(n_);
  Info info;
  Vector x(b.size());
  // The matrix itself is needed for iterative refinement only.
  const int status = umfpack_di_solve(UMFPACK_A, nullptr, nullptr, nullptr, x.data(), b.data(), numeric_,
                                      control.data(), info.data());
  check(status, "solution", n_);
  return x;
}

}  // namespace fpi::fluid
