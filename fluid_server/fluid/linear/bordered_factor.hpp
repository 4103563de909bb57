/// Factor of a sparse matrix with a few dense rows and columns around it, from that of the matrix alone: one
/// back-solve a column when it is made, none more afterwards.
#pragma once

#include <memory>

#include "fluid/linear/linear_solver.hpp"

namespace fpi::fluid {

using Columns = Eigen::MatrixXd;

/// Factor of [A, columns; rowsᵀ, 0]. Singular where A is, or where the border is not independent of it.
std::shared_ptr<const Factor> with_border(std::shared_ptr<const Factor> inner, const Columns& columns,
                                          const Columns& rows);

}  // namespace fpi::fluid
