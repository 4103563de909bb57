/// MUMPS, sequential: unsymmetric multifrontal LU. Its larger dense blocks make it faster than UMFPACK from
/// some ten thousand unknowns on.
#pragma once

#include "fluid/linear_solver.hpp"

namespace fpi::fluid {

std::shared_ptr<const Analysis> analyse_with_mumps(const BlockMatrix& matrix);

}  // namespace fpi::fluid
