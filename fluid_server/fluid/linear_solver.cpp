#include "fluid/linear_solver.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#ifdef FPI_MUMPS
#include "fluid/mumps.hpp"
#endif
#include "fluid/umfpack.hpp"

namespace fpi::fluid {
namespace {

struct Backend {
  std::string_view name;
  std::shared_ptr<const Analysis> (*analyse)(const BlockMatrix&);
};

constexpr auto backends = std::to_array<Backend>({
    {"umfpack", analyse_with_umfpack},
#ifdef FPI_MUMPS
    {"mumps", analyse_with_mumps},
#endif
});

const Backend& find(std::string_view solver) {
  const auto* backend = std::ranges::find(backends, solver, &Backend::name);
  require(backend != backends.end(),
          "linear_solver must be one that this build has ({}); got \"{}\": take one of these, or install its "
          "library and build again (for mumps: libmumps-seq-dev, -DFPI_MUMPS=ON)",
          fmt::join(linear_solvers(), ", "), solver);
  return *backend;
}

}  // namespace

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

std::vector<std::string_view> linear_solvers() {
  std::vector<std::string_view> names;
  for (const Backend& backend : backends) names.push_back(backend.name);
  return names;
}

void check_linear_solver(std::string_view solver) { find(solver); }

std::shared_ptr<const Analysis> analyse(const BlockMatrix& matrix, std::string_view solver) {
  require(matrix.n() > 0,
          "at least one unknown is required; got none: the boundaries prescribe every velocity, take a finer "
          "mesh");
  return find(solver).analyse(matrix);
}

}  // namespace fpi::fluid
