/// One run of the coupler as a process: folder, log, participants over the wire, the run, and its summary.
#pragma once

#include <string>
#include <vector>

namespace fpi {

struct RunOptions {
  std::string scene;                   ///< file; where a run is resumed, that of its folder
  std::vector<std::string> overrides;  ///< "key=value"
  std::string folder;                  ///< of the results
  std::string stages = "runs/stages";  ///< folder of the runs of scenes that come before
  std::string listen = "tcp://127.0.0.1:*";
  std::string keys;          ///< folder; "": none, loopback only
  bool watch_stdin = false;  ///< the launcher tells there which participants ended
  bool resume = false;
};

/// Returns the exit status: 0 only where the run reached its end. summary.json says which, in every case
/// where the folder can be written. Stops at the next answer after proto::Host::interrupt().
int run_process(const RunOptions& options);

}  // namespace fpi
