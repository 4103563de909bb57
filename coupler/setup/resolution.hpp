/// How finely a run is resolved, as far as it is known before the first step: what participants said of the
/// scene when they were configured, and elements across bodies.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "step/coupled_problem.hpp"

namespace fpi {

struct Resolution {
  std::string coarsest_body;  ///< with the fewest elements across its diameter; "" where there is none
  /// "elements_per_diameter" of that body, "time_step" [s]; "contact_time" [s] of the shortest impact to
  /// expect; of the fluid see ResolutionReport.
  std::map<std::string, double> figures;
};

/// Of participants that are configured.
Resolution resolution(const scene::Scene& scene, const CoupledProblem& problem);

/// As lines of a log.
std::vector<std::string> describe(const Resolution& resolution);

}  // namespace fpi
