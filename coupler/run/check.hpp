/// `check`: a run's own set-up up to its first step, which is not taken. Everything that would refuse it is
/// told at once.
#pragma once

#include <string>
#include <vector>

#include "run/check_report.hpp"
#include "run/run_process.hpp"

namespace fpi {

/// Prints the report, as JSON where `json`. With options.watch_stdin the launcher is there and starts the
/// participants that are our own once it was told "plan …" and "address …"; without, they are not asked. No
/// run folder is made. Returns the exit status: 0 only where nothing would refuse the run.
int check_scene(const RunOptions& options, bool json);

}  // namespace fpi
