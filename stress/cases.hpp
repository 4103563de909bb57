/// The cases of the stress sweep. A case is made from its name, the seed and nothing else, and says how it
/// went in numbers that any other case has, too.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "random.hpp"

namespace fpi::fluid::testing {

/// How a case went. Quantities that it does not measure stay negative.
struct Outcome {
  std::map<std::string, double> parameters;  ///< what was drawn for it
  std::string failure;                       ///< "" where it survived
  bool refused = false;                      ///< the failure is a sentence of the fluid's own
  double error = -1;                         ///< against what is known of it, relative
  double noise = -1;                         ///< of the force, see Noise::worst
  double condition = -1;                     ///< equilibrated estimate, the worst of its steps

  void fail_unless(bool good, const std::string& why) {
    if (!good && failure.empty()) failure = why;
  }
};

/// How much a case may cost.
struct Effort {
  double finest;  ///< largest D/h
  int steps;      ///< of moving bodies
};

struct Family {
  std::string name;
  std::string title;
  double share;  ///< of all cases
  std::function<Outcome(Random&, const Effort&)> run;
};

std::vector<Family> exact_families();   ///< against exact flows and symmetry, one steady solve each
std::vector<Family> moving_families();  ///< several steps of bodies that move, meet and leave

}  // namespace fpi::fluid::testing
