/// The direct solvers of this build, and which of them suits a matrix. Each library stays in the source that
/// wraps it; every status it returns is checked.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "fluid/linear/factor.hpp"
#include "fluid/linear/nested_dissection.hpp"

namespace fpi::fluid {

/// The solvers of this build.
std::vector<std::string_view> linear_solvers();

/// Throws Error where this build lacks the solver.
void check_linear_solver(std::string_view solver);

/// Whether the factors of a solver give Schur complements; "auto" does where one of this build's does.
bool gives_schur_complements(std::string_view solver);

/// Analyses the pattern of `matrix` with one of `linear_solvers()`, or the one that suits best ("auto"). The
/// `clusters` are all unknowns by place, where they are known. The unknowns `last`, whole clusters, are
/// eliminated last, so that factors have their Schur complement, which the solver must be one to give. Throws
/// Error for a matrix without unknowns.
std::shared_ptr<const Analysis> analyse(const BlockMatrix& matrix, std::string_view solver,
                                        std::span<const Cluster> clusters = {},
                                        std::span<const Index> last = {});

}  // namespace fpi::fluid
