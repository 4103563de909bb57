/// Extrema, means and frequencies of the coefficients and probes of a run, read back from its history: a run
/// that was resumed has them whole. They stand in a file beside, extrema.csv, since a line of the history is
/// a step and these have a line a signal.
#pragma once

#include <map>
#include <string>

#include "results/signal.hpp"
#include "scene/scene.hpp"

namespace fpi {

struct MeasuredSignal {
  SignalFigures figures;
  std::optional<double> strouhal;  ///< f L/U of a lift coefficient
};
using MeasuredSignals = std::map<std::string, MeasuredSignal>;  ///< by column of the history

/// From scene.output.measure_from on, else over the second half of the run; nothing of a steady run.
MeasuredSignals measure_signals(const scene::Scene& scene, const std::string& folder);

/// Writes FOLDER/extrema.csv, where there is anything to write.
void write_extrema(const MeasuredSignals& signals, const std::string& folder);

}  // namespace fpi
