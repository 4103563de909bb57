/// What drove the flow at the onset of motion, read from the history that the run wrote.
#pragma once

#include <map>
#include <string>

#include "step/onset.hpp"

namespace fpi {

/// What drove the flow then: probes, forces of boundaries and pressures found, by their columns of the
/// history in `folder`.
std::map<std::string, double> drives_at(const Onset& onset, const scene::Scene& scene,
                                        const std::string& folder);

}  // namespace fpi
