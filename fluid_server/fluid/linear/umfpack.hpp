/// UMFPACK: unsymmetric multifrontal LU of SuiteSparse.
#pragma once

#include "fluid/linear/factor.hpp"

namespace fpi::fluid {

std::shared_ptr<const Analysis> analyse_with_umfpack(const BlockMatrix& matrix);

}  // namespace fpi::fluid
