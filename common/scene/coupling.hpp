/// [coupling]: the implicit staggered iteration of each time step.
#pragma once

#include <array>
#include <string>

#include "core/parameters.hpp"

namespace fpi::scene {

struct Coupling {
  std::string acceleration = "aitken";
  double relaxation = 0.5;           ///< ω: constant, or Aitken's first
  double relative_tolerance = 1e-5;  ///< of velocity and force against their size in the step
  double absolute_velocity = 1e-10;  ///< [m/s]
  double absolute_force = 1e-12;     ///< [N]
  std::int64_t max_iterations = 50;
  std::string predictor = "linear";
  double participant_timeout = 10;  ///< [s] without any sign of life

  static constexpr std::array<std::string_view, 2> accelerations{"constant", "aitken"};
  static constexpr std::array<std::string_view, 2> predictors{"constant", "linear"};

  void declare(ParameterVisitor& v) {
    v.choice(
        {"acceleration", "", "how the next interface velocity is found: constant or Aitken's relaxation"},
        acceleration, accelerations);
    v.real({"relaxation", "", "the constant relaxation factor, or Aitken's first"}, relaxation,
           above_up_to(0, 2));
    v.real({"relative_tolerance", "", "change of velocity and force in a sub-iteration, against their size"},
           relative_tolerance, above_up_to(0, 0.1));
    v.real({"absolute_velocity", "m/s", "a change of velocity below this counts as converged"},
           absolute_velocity, not_negative());
    v.real({"absolute_force", "N", "a change of force below this counts as converged"}, absolute_force,
           not_negative());
    v.integer({"max_iterations", "", "sub-iterations before the step is rejected and halved"}, max_iterations,
              between(1, 10000));
    v.choice({"predictor", "", "first guess of the velocity: that of the last step, or extrapolated"},
             predictor, predictors);
    v.real({"participant_timeout", "s", "a participant silent for this long has vanished"},
           participant_timeout, between(1, 3600));
  }
};

}  // namespace fpi::scene
