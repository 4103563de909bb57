/// [coupling]: the implicit staggered iteration of each time step.
#pragma once

#include <array>
#include <string>

#include "core/parameters.hpp"

namespace fpi::scene {

struct Coupling {
  std::string scheme = "auto";
  std::string acceleration = "iqn-imvj";
  double relaxation = 1;  ///< ω: constant, or the first of the others
  std::string response = "auto";
  double relative_tolerance = 1e-5;  ///< of velocity and force against their size in the step
  double absolute_velocity = 1e-10;  ///< [m/s]
  double absolute_force = 1e-12;     ///< [N]
  std::int64_t max_iterations = 50;
  std::string predictor = "auto";
  double recut_above = 0.1;         ///< of h
  double hold_below = 1e-3;         ///< of h
  double participant_timeout = 30;  ///< [s] without any sign of life

  static constexpr std::array<std::string_view, 4> schemes{"auto", "implicit", "semi_implicit", "explicit"};
  static constexpr std::array<std::string_view, 4> accelerations{"constant", "aitken", "iqn-ils", "iqn-imvj"};
  static constexpr std::array<std::string_view, 4> responses{"auto", "none", "analytic", "fluid"};
  static constexpr std::array<std::string_view, 5> predictors{"auto", "constant", "linear", "quadratic",
                                                              "physical"};

  void declare(ParameterVisitor& v) {
    v.choice({"scheme", "",
              "implicit: sub-iterations until fluid and grains agree; semi_implicit: the motion is corrected "
              "once, "
              "two sub-iterations a step; explicit: one sub-iteration; auto: implicit, but bodies much "
              "heavier than the "
              "fluid are not verified where the next sub-iteration is proven to be within the tolerance"},
             scheme, schemes);
    v.choice(
        {"acceleration", "",
         "how the next iterate is found: constant or Aitken's relaxation, or interface quasi-Newton with "
         "least squares over the last steps (iqn-ils) or with an inverse Jacobian that is carried on "
         "(iqn-imvj)"},
        acceleration, accelerations);
    v.real({"relaxation", "", "the constant relaxation factor, or the first of the others"}, relaxation,
           above_up_to(0, 2));
    v.choice(
        {"response", "",
         "what is known of how the fluid resists a body's motion: nothing, that of a disc by itself in "
         "Stokes flow, or all of it, where the fluid solves the bodies' balances with its own equations; "
         "auto: the most that the programs can"},
        response, responses);
    v.real({"relative_tolerance", "", "change of velocity and force in a sub-iteration, against their size"},
           relative_tolerance, above_up_to(0, 0.1));
    v.real({"absolute_velocity", "m/s", "a change of velocity below this counts as converged"},
           absolute_velocity, not_negative());
    v.real({"absolute_force", "N", "a change of force below this counts as converged"}, absolute_force,
           not_negative());
    v.integer({"max_iterations", "", "sub-iterations before the step is rejected and halved"}, max_iterations,
              between(1, 10000));
    v.choice(
        {"predictor", "",
         "first guess of the velocity: that of the last step, extrapolated linearly or quadratically, or by "
         "the equation of motion with the last force; auto: for each body the best so far"},
        predictor, predictors);
    v.real(
        {"recut_above", "h",
         "where a body ends farther than this from where it was predicted, in element sizes beside it, the "
         "geometry is cut anew and the step repeated from there; 0: never"},
        recut_above, not_negative());
    v.real(
        {"hold_below", "h",
         "a free body that stays this close to where it was last cut, in element sizes beside it, is not cut "
         "anew: while all do, the matrix keeps its factor; 0: every step cuts"},
        hold_below, not_negative());
    v.real({"participant_timeout", "s",
            "who is silent for this long has vanished: a participant to the coupler, and the coupler to it"},
           participant_timeout, between(1, 86400));
  }
};

}  // namespace fpi::scene
