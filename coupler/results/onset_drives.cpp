#include "results/onset_drives.hpp"

#include <algorithm>

#include "output/table.hpp"
#include "results/recorder.hpp"
#include "results/reported.hpp"

namespace fpi {

std::map<std::string, double> drives_at(const Onset& onset, const scene::Scene& scene,
                                        const std::string& folder) {
  const output::Columns history = output::read_columns(history_file(folder));
  const std::vector<double>& time = history.at("time");
  const auto row = std::ranges::find(time, onset.time) - time.begin();
  std::vector<std::string> columns = found_drives(scene);
  for (const scene::Probe& probe : scene.probes) columns.push_back(probe.name);
  for (const std::string& boundary : holding_boundaries(scene))
    for (const char* quantity : {".fx", ".fy"}) columns.push_back(boundary + quantity);
  std::map<std::string, double> values;
  for (const std::string& column : columns)
    values[column] = history.at(column).at(static_cast<std::size_t>(row));
  return values;
}

}  // namespace fpi
