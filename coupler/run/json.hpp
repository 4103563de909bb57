/// What the coupler says to other programs, as JSON. The JSON library stays in the source file.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.hpp"
#include "results/extrema.hpp"
#include "results/groups.hpp"
#include "run/check_report.hpp"
#include "run/time_loop.hpp"
#include "setup/plan.hpp"
#include "setup/resolution.hpp"

namespace fpi {

/// All of summary.json.
struct Summary {
  RunOrigin origin;
  std::string status = "failed";  ///< "completed" | "failed"
  std::string reason;             ///< why failed, or ""
  Statistics statistics;
  std::uint64_t steps_before = 0;  ///< of these, those that the run had taken when it was resumed
  /// Of participants by role, as they said goodbye; a role that was lost is there without figures.
  std::map<std::string, proto::Figures> figures;
  std::string worst_body;                                     ///< of the coupling, or ""
  std::map<std::string, double> waited_for;                   ///< [s] by role
  double wall_total = 0, wall_coupling = 0, wall_output = 0;  ///< [s]
  double peak_memory = 0;                                     ///< [B] of this process
  std::vector<std::string> body_names;
  CoupledState bodies;
  std::vector<GroupMotion> groups;
  std::string onset_body;                      ///< that moved first, or ""
  std::map<std::string, double> onset_drives;  ///< that moved it
  std::vector<std::string> outlet_names;
  std::vector<std::string> boundary_names;
  std::vector<BoundaryLoad> boundaries;
  std::map<std::string, double> coefficients, probes, drives;
  MeasuredSignals signals;
  std::vector<std::string> profile_names;
  Resolution resolution;
  std::vector<std::string> warnings;
};

/// What flows through the surfaces of bodies over the largest flow through a boundary or that bodies push; 0
/// where there is none.
double leak_share(const Summary& summary);

/// What the coupling took, as lines of a log.
std::vector<std::string> coupling_table(const Summary& summary);

std::string to_json(const Plan& plan);
std::string to_json(const RunProgress& progress);
std::string to_json(const Summary& summary);
std::string to_json(const CheckReport& report);

/// Of the text of a summary with the status "completed"; nothing for any other text.
std::optional<RunOrigin> origin_if_completed(const std::string& summary);

}  // namespace fpi
