/// Newton–Raphson on the discrete equations, with a factor that is kept for as long as it serves (numerics.md
/// section 3): each correction costs one residual and one back-solve, and a new factor only where corrections
/// shrink too slowly.
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

/// A guess, and the factor that corrects it.
struct Iterate {
  Fields fields;
  std::shared_ptr<const Factor> factor;  ///< null: to be made at the guess
};

struct NewtonResult {
  bool converged = false;
  std::string reason;  ///< why not
  int iterations = 0;
  double update = 0;  ///< last |δu|/|u|
};

/// Improves `iterate` until |δu| ≤ tolerance · |u|. A linear problem takes one correction with its own
/// factor.
NewtonResult solve(System& system, const Flow& flow, const TimeTerms& time, const scene::Newton& parameters,
                   Iterate& iterate, Monitor& monitor);

}  // namespace fpi::fluid
