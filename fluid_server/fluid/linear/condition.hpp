/// How far a matrix is from being singular, whatever the units of its equations and unknowns: its condition
/// number in the 1-norm after rows and columns were scaled alike.
#pragma once

#include "fluid/linear/linear_solver.hpp"

namespace fpi::fluid {

/// ‖Â‖₁ ‖Â⁻¹‖₁, where Â is the matrix with rows and columns scaled until the Euclidean length of each is near
/// 1 (P. A. Knight, D. Ruiz, B. Uçar, SIAM J. Matrix Anal. Appl. 35, 2014), which only one scaling does. The
/// norm of the inverse is estimated from below with some ten solves (N. J. Higham, ACM Trans. Math. Softw.
/// 14, 1988). Infinite where the factor, which must be the matrix's own, is singular.
double condition_estimate(const BlockMatrix& matrix, const Factor& factor);

}  // namespace fpi::fluid
