#include "results/extrema.hpp"

#include <fmt/format.h>

#include <cmath>

#include "output/replace.hpp"
#include "output/table.hpp"
#include "results/recorder.hpp"
#include "results/reported.hpp"

namespace fpi {
namespace {

/// Samples of one column from a time on; a probe has none while a body covers it.
struct Window {
  std::vector<double> time, value;
};

Window window(const output::Columns& history, const std::string& column, double from) {
  Window out;
  const std::vector<double>& time = history.at("time");
  const std::vector<double>& value = history.at(column);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < from || !std::isfinite(value[i])) continue;
    out.time.push_back(time[i]);
    out.value.push_back(value[i]);
  }
  return out;
}

std::string line(const std::string& name, const MeasuredSignal& signal) {
  const SignalFigures& f = signal.figures;
  std::string text = fmt::format("{},{},{},{},{},{}", name, f.smallest.value, f.smallest.time,
                                 f.largest.value, f.largest.time, f.mean);
  if (const auto& o = f.oscillation) {
    text += fmt::format(",{},{},{},{}", o->frequency, o->periods, o->peak_spread, o->is_settled() ? 1 : 0);
  } else {
    text += ",,,,";
  }
  return text + (signal.strouhal ? fmt::format(",{}\n", *signal.strouhal) : ",\n");
}

}  // namespace

MeasuredSignals measure_signals(const scene::Scene& scene, const std::string& folder) {
  MeasuredSignals out;
  if (scene.time.steady || (scene.coefficients.empty() && scene.probes.empty())) return out;
  const output::Columns history = output::read_columns(history_file(folder));
  const double from = scene.output.measure_from.value_or(0.5 * scene.time.end);
  const auto measure = [&](const std::string& column) -> MeasuredSignal* {
    const Window samples = window(history, column, from);
    if (samples.time.empty()) return nullptr;
    return &out.emplace(column, MeasuredSignal{analyse_signal(samples.time, samples.value), {}})
                .first->second;
  };
  for (const scene::Coefficients& c : scene.coefficients) {
    measure(column_of(c, "drag"));
    MeasuredSignal* lift = measure(column_of(c, "lift"));
    if (lift && lift->figures.oscillation)
      lift->strouhal = lift->figures.oscillation->frequency * c.length / c.velocity;
  }
  for (const scene::Probe& probe : scene.probes) measure(probe.name);
  return out;
}

void write_extrema(const MeasuredSignals& signals, const std::string& folder) {
  if (signals.empty()) return;
  std::string text = "signal,min,min_time,max,max_time,mean,frequency,periods,peak_spread,settled,strouhal\n";
  for (const auto& [name, signal] : signals) text += line(name, signal);
  output::replace_text(folder + "/extrema.csv", text);
}

}  // namespace fpi
