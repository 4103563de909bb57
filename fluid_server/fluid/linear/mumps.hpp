/// MUMPS, sequential: unsymmetric multifrontal LU. Its larger dense blocks make it faster than UMFPACK from
/// some ten thousand unknowns on.
#pragma once

#include "fluid/linear/factor.hpp"
#include "fluid/linear/nested_dissection.hpp"

namespace fpi::fluid {

/// The unknowns `last` have a Schur complement.
std::shared_ptr<const Analysis> analyse_with_mumps(const BlockMatrix& matrix,
                                                   std::span<const Cluster> clusters,
                                                   std::span<const Index> last);

}  // namespace fpi::fluid
