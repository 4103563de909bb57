/// Integrals over time of formulas that may jump or bend, such as "t < 0.35 ? 1 : 0".
#pragma once

#include "core/expression.hpp"

namespace fpi::coupling {

/// ∫ f(0, 0, t) dt from t0 to t1: Gauss–Legendre quadrature of order 10 where it is as good as on both
/// halves, to 1e-10 of the largest value met times t1 − t0; else the halves, each in turn, so that a jump is
/// closed in on to 1e-12 of the step. Numbers that stand in the formula divide the step first: no pulse
/// between two of them is too short to be seen. Others are seen where they last for a hundredth of the step.
double integral(const Expression& formula, double t0, double t1);

}  // namespace fpi::coupling
