#include "fluid/umfpack.hpp"

#include <umfpack.h>

#include <array>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

using Control = std::array<double, UMFPACK_CONTROL>;
using Info = std::array<double, UMFPACK_INFO>;

/// The pattern is symmetric; the default pivot tolerance fills in from the multipliers' pivots; iterative
/// refinement is left to the outer iteration. From some 200 000 unknowns nested dissection pays.
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

class UmfpackFactor final : public Factor {
 public:
  UmfpackFactor(void* symbolic, const BlockMatrix& matrix) : Factor(matrix.n()) {
    const Control control = control_for(n_);
    Info info;
    const int status = umfpack_di_numeric(matrix.column_start().data(), matrix.row().data(), matrix.values(),
                                          symbolic, &numeric_, control.data(), info.data());
    check(status, "factorisation", n_);
    is_singular_ = status == UMFPACK_WARNING_singular_matrix;
    // Fitted to 10 to 110 thousand unknowns: handling an entry of the factors takes longer than computing it.
    const double entries = info[UMFPACK_LNZ] + info[UMFPACK_UNZ];
    factor_cost_ = 1e-10 * info[UMFPACK_FLOPS] + 5e-8 * entries;
    solve_cost_ = 2e-9 * entries;
  }
  ~UmfpackFactor() override { umfpack_di_free_numeric(&numeric_); }

 private:
  Vector back_solve(const Vector& b, Form form) const override {
    const Control control = control_for(n_);
    Info info;
    Vector x(n_);
    // The matrix itself is needed for iterative refinement only.
    const int status = umfpack_di_solve(form == Form::plain ? UMFPACK_A : UMFPACK_At, nullptr, nullptr,
                                        nullptr, x.data(), b.data(), numeric_, control.data(), info.data());
    check(status, "solution", n_);
    return x;
  }

  void* numeric_ = nullptr;
};

class UmfpackAnalysis final : public Analysis {
 public:
  explicit UmfpackAnalysis(const BlockMatrix& matrix) : Analysis(matrix) {
    const Control control = control_for(matrix.n());
    Info info;
    const int status =
        umfpack_di_symbolic(matrix.n(), matrix.n(), matrix.column_start().data(), matrix.row().data(),
                            nullptr, &symbolic_, control.data(), info.data());
    check(status, "analysis", matrix.n());
  }
  ~UmfpackAnalysis() override { umfpack_di_free_symbolic(&symbolic_); }

 private:
  std::shared_ptr<const Factor> make_factor(const BlockMatrix& matrix) const override {
    return std::make_shared<UmfpackFactor>(symbolic_, matrix);
  }

  void* symbolic_ = nullptr;
};

}  // namespace

std::shared_ptr<const Analysis> analyse_with_umfpack(const BlockMatrix& matrix) {
  return std::make_shared<UmfpackAnalysis>(matrix);
}

}  // namespace fpi::fluid
