/// `check`: a run's own set-up up to its first step, which is not taken. Everything that would refuse it is
/// told at once.
#pragma once

#include <string>
#include <vector>

#include "core/findings.hpp"
#include "plan.hpp"
#include "resolution.hpp"
#include "session.hpp"

namespace fpi {

struct CheckReport {
  std::string scene;  ///< its file
  Plan plan;
  Findings findings;                     ///< by file and line
  std::vector<std::string> not_checked;  ///< what could not be looked at, and why
  std::vector<std::string> notes;        ///< groups of grains
  Resolution resolution;

  bool is_ok() const { return !findings.has_errors(); }
};

/// As lines for a reader.
std::vector<std::string> to_text(const CheckReport& report);

/// Prints the report, as JSON where `json`. With options.watch_stdin the launcher is there and starts the
/// participants that are our own once it was told "plan …" and "address …"; without, they are not asked. No
/// run folder is made. Returns the exit status: 0 only where nothing would refuse the run.
int check_scene(const SessionOptions& options, bool json);

}  // namespace fpi
