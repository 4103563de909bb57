/// coupler: reads the scene, owns time, iterates between fluid and DEM, and writes all results.

#include <csignal>
#include <cstdio>

#include "command_line.hpp"
#include "core/error.hpp"
#include "core/pages.hpp"
#include "proto/host.hpp"
#include "proto/keys.hpp"
#include "run/check.hpp"
#include "run/json.hpp"
#include "run/run_folder.hpp"
#include "run/stages.hpp"
#include "scene/scene.hpp"
#include "setup/plan.hpp"

namespace fpi {
namespace {

extern "C" void on_stop_signal(int) { proto::Host::interrupt(); }

void listen_to_signals() {
  std::signal(SIGINT, on_stop_signal);
  std::signal(SIGTERM, on_stop_signal);
  std::signal(SIGPIPE, SIG_IGN);  // a launcher that is gone must not take the results with it
}

void print_plan(const RunOptions& options) {
  StagedScene staged = read_staged(options.scene, options.overrides, options.stages);
  const Files files = read_files(find_files(staged, options.scene, Unready::leave_out), options.scene);
  std::puts(to_json(make_plan(staged, files)).c_str());
}

int carry_out(const CommandLine& line) {
  switch (line.task) {
    case Task::run:
      return run_process(line.run);
    case Task::check:
      return check_scene(line.run, line.json);
    case Task::plan:
      print_plan(line.run);
      return 0;
    case Task::reference:
      std::fputs(scene::reference().c_str(), stdout);
      return 0;
    case Task::make_keys:
      proto::make_keys(line.keys_folder);
      return 0;
  }
  return 1;
}

}  // namespace
}  // namespace fpi

int main(int argc, char** argv) {
  fpi::keep_pages();
  const fpi::CommandLine line = fpi::read_coupler_command_line(argc, argv);
  if (line.exit_status) return *line.exit_status;
  fpi::listen_to_signals();
  try {
    return fpi::carry_out(line);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "coupler: %s\n", e.what());
    return 1;
  }
}
