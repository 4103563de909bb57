/// Newton–Raphson on the discrete equations with a factor that is kept for as long as it pays (numerics.md
/// section 3): a correction costs one residual and one back-solve, a twentieth of a factor. Corrections by an
/// old factor are accelerated by Anderson's mixing, which is GMRES for a problem that is nearly linear; steps
/// with a new one are damped by the natural monotonicity test (Deuflhard, Newton Methods for Nonlinear
/// Problems, 2004, section 3.3).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "fluid/system.hpp"

namespace fpi::fluid {

/// Where the time goes, and who wants to know what is being done.
struct Monitor {
  Ledger ledger;
  std::function<void(const char*)> phase = [](const char*) {};
};

/// A guess, and the factor that corrects it with what it has cost so far.
struct Iterate {
  Fields fields;
  std::shared_ptr<const Factor> factor;  ///< null: to be made at the guess
  double cost = 0;                       ///< of the factor and of all solves with it, see Factor::cost
};

struct NewtonResult {
  bool converged = false;
  std::string reason;  ///< why not
  int iterations = 0;  ///< corrections: residuals and back-solves
  double update = 0;   ///< last |δu|/|u|
};

/// Improves `iterate` until what is left of the velocity's error is estimated below tolerance · |u|. A linear
/// problem takes one correction with its own factor. `iterate` is as good as it got where that fails.
NewtonResult solve(System& system, const Flow& flow, const TimeTerms& time, const scene::Newton& parameters,
                   Iterate& iterate, Monitor& monitor);

}  // namespace fpi::fluid
