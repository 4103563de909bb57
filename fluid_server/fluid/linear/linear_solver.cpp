#include "fluid/linear/linear_solver.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#ifdef FPI_MUMPS
#include "fluid/linear/mumps.hpp"
#endif
#include "fluid/linear/umfpack.hpp"

namespace fpi::fluid {
namespace {

struct Backend {
  std::string_view name;
  bool gives_schur_complements;
  Index best_from;  ///< unknowns, from which it is the fastest
  std::shared_ptr<const Analysis> (*analyse)(const BlockMatrix&, std::span<const Cluster>,
                                             std::span<const Index> last);
};

constexpr auto backends = std::to_array<Backend>({
    {"umfpack", false, 0,
     [](const BlockMatrix& matrix, std::span<const Cluster>, std::span<const Index>) {
       return analyse_with_umfpack(matrix);
     }},
#ifdef FPI_MUMPS
    {"mumps", true, 30'000, analyse_with_mumps},
#endif
});

/// The one that has the name or, where it is "auto", suits best; null where none does.
const Backend* find(std::string_view name, bool with_schur_complement, Index n) {
  const Backend* best = nullptr;
  for (const Backend& backend : backends) {
    if (name != "auto" && name != backend.name) continue;
    if (with_schur_complement && !backend.gives_schur_complements) continue;
    if (best == nullptr || n >= backend.best_from) best = &backend;
  }
  return best;
}

}  // namespace

std::vector<std::string_view> linear_solvers() {
  std::vector<std::string_view> names;
  for (const Backend& backend : backends) names.push_back(backend.name);
  return names;
}

void check_linear_solver(std::string_view solver) {
  require(find(solver, false, 0) != nullptr,
          "linear_solver must be auto or one that this build has ({}); got \"{}\": take one of these, or "
          "install its library and build again (for mumps: libmumps-seq-dev, -DFPI_MUMPS=ON)",
          fmt::join(linear_solvers(), ", "), solver);
}

bool gives_schur_complements(std::string_view solver) { return find(solver, true, 0) != nullptr; }

std::shared_ptr<const Analysis> analyse(const BlockMatrix& matrix, std::string_view solver,
                                        std::span<const Cluster> clusters, std::span<const Index> last) {
  require(matrix.n() > 0,
          "at least one unknown is required; got none: the boundaries prescribe every velocity, take a finer "
          "mesh");
  check_linear_solver(solver);
  const Backend* backend = find(solver, !last.empty(), matrix.n());
  require(backend != nullptr, "a linear solver that gives Schur complements is required; {} does not",
          solver);
  return backend->analyse(matrix, clusters, last);
}

}  // namespace fpi::fluid
