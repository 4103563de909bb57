/// Newton–Raphson on the discrete equations with a factor that is kept for as long as it pays (numerics.md
/// section 3): a correction costs one residual and one back-solve, a twentieth of a factor. Corrections by an
/// old factor are accelerated by Anderson's mixing, which is GMRES for a problem that is nearly linear; steps
/// with a new one are damped by the natural monotonicity test (Deuflhard, Newton Methods for Nonlinear
/// Problems, 2004, section 3.3).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "fluid/discretisation/system.hpp"

namespace fpi::fluid {

/// Where the time goes, and who wants to know what is being done.
struct Profiler {
  Timers timers;
  std::function<void(const char*)> phase = [](const char*) {};
};

/// What turns residuals into corrections.
struct Corrector {
  std::shared_ptr<const Factor> factor;         ///< null: to be made at the guess
  std::shared_ptr<const Background> reference;  ///< that the factor was made from, or is to be; null: none
  /// The problem is linear, and the factor is that of its very matrix.
  bool is_exact = false;
  double cost = 0;  ///< of the reference and all that was made from it and solved with it, see Factor
};

/// A guess, and what corrects it.
struct Iterate {
  Fields fields;
  Corrector corrector;
};

struct NewtonResult {
  bool converged = false;
  std::string reason;  ///< why not
  int iterations = 0;  ///< corrections: residuals and back-solves
  double update = 0;   ///< last |δu|/|u|
};

/// Improves `iterate` until what is left of the velocity's error is estimated below tolerance · |u|. A linear
/// problem takes one correction with an exact factor. `iterate` is as good as it got where that fails.
NewtonResult solve(System& system, const Flow& flow, const TimeTerms& time, const scene::Newton& parameters,
                   Iterate& iterate, Profiler& monitor);

}  // namespace fpi::fluid
