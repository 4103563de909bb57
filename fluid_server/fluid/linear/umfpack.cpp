#include "fluid/linear/umfpack.hpp"

#include <umfpack.h>

#include <array>
#include <vector>

#include "core/error.hpp"

namespace fpi::fluid {
namespace {

/// UMFPACK's calls with 32-bit integers, and with 64-bit ones where the factors may hold more than those
/// count.
struct Narrow {
  using Int = Index;
  static constexpr auto symbolic = umfpack_di_symbolic;
  static constexpr auto numeric = umfpack_di_numeric;
  static constexpr auto solve = umfpack_di_solve;
  static constexpr auto free_symbolic = umfpack_di_free_symbolic;
  static constexpr auto free_numeric = umfpack_di_free_numeric;
};
struct Wide {
  using Int = SuiteSparse_long;
  static constexpr auto symbolic = umfpack_dl_symbolic;
  static constexpr auto numeric = umfpack_dl_numeric;
  static constexpr auto solve = umfpack_dl_solve;
  static constexpr auto free_symbolic = umfpack_dl_free_symbolic;
  static constexpr auto free_numeric = umfpack_dl_free_numeric;
};
constexpr Index widest_narrow = 400000;  ///< unknowns; one of 983 000 needs the wide ones

/// The pattern of a matrix in the integers of the calls.
template <class Int>
class ColumnPattern {
 public:
  explicit ColumnPattern(const BlockMatrix& matrix)
      : start_(matrix.column_start().begin(), matrix.column_start().end()),
        row_(matrix.row().begin(), matrix.row().end()) {}
  const Int* start() const { return start_.data(); }
  const Int* row() const { return row_.data(); }

 private:
  std::vector<Int> start_, row_;
};
template <>
class ColumnPattern<Index> {
 public:
  explicit ColumnPattern(const BlockMatrix& matrix) : matrix_(matrix) {}
  const Index* start() const { return matrix_.column_start().data(); }
  const Index* row() const { return matrix_.row().data(); }

 private:
  const BlockMatrix& matrix_;
};

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

template <class Calls>
class UmfpackFactor final : public Factor {
 public:
  UmfpackFactor(void* symbolic, const BlockMatrix& matrix) : Factor(matrix.n()) {
    const Control control = control_for(n_);
    Info info;
    const ColumnPattern<typename Calls::Int> pattern(matrix);
    const auto status = static_cast<int>(Calls::numeric(pattern.start(), pattern.row(), matrix.values(),
                                                        symbolic, &numeric_, control.data(), info.data()));
    check(status, "factorisation", n_);
    is_singular_ = status == UMFPACK_WARNING_singular_matrix;
    // Fitted to 10 to 110 thousand unknowns: handling an entry of the factors takes longer than computing it.
    const double entries = info[UMFPACK_LNZ] + info[UMFPACK_UNZ];
    factor_cost_ = 1e-10 * info[UMFPACK_FLOPS] + 5e-8 * entries;
    solve_cost_ = 2e-9 * entries;
  }
  ~UmfpackFactor() override { Calls::free_numeric(&numeric_); }

 private:
  Vector back_solve(const Vector& b, Form form) const override {
    const Control control = control_for(n_);
    Info info;
    Vector x(n_);
    // The matrix itself is needed for iterative refinement only.
    const auto status =
        static_cast<int>(Calls::solve(form == Form::plain ? UMFPACK_A : UMFPACK_At, nullptr, nullptr, nullptr,
                                      x.data(), b.data(), numeric_, control.data(), info.data()));
    check(status, "solution", n_);
    return x;
  }

  void* numeric_ = nullptr;
};

template <class Calls>
class UmfpackAnalysis final : public Analysis {
 public:
  explicit UmfpackAnalysis(const BlockMatrix& matrix) : Analysis(matrix) {
    const Control control = control_for(matrix.n());
    Info info;
    const ColumnPattern<typename Calls::Int> pattern(matrix);
    const auto status =
        static_cast<int>(Calls::symbolic(matrix.n(), matrix.n(), pattern.start(), pattern.row(), nullptr,
                                         &symbolic_, control.data(), info.data()));
    check(status, "analysis", matrix.n());
  }
  ~UmfpackAnalysis() override { Calls::free_symbolic(&symbolic_); }

 private:
  std::shared_ptr<const Factor> make_factor(const BlockMatrix& matrix) const override {
    return std::make_shared<UmfpackFactor<Calls>>(symbolic_, matrix);
  }

  void* symbolic_ = nullptr;
};

}  // namespace

std::shared_ptr<const Analysis> analyse_with_umfpack(const BlockMatrix& matrix) {
  if (matrix.n() > widest_narrow) return std::make_shared<UmfpackAnalysis<Wide>>(matrix);
  return std::make_shared<UmfpackAnalysis<Narrow>>(matrix);
}

}  // namespace fpi::fluid
