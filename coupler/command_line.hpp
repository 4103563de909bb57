/// The coupler's command line. CLI11 stays in the source file.
#pragma once

#include <optional>
#include <string>

#include "run/run_process.hpp"

namespace fpi {

enum class Task { run, plan, check, reference, make_keys };

struct CommandLine {
  Task task = Task::run;
  RunOptions run;
  std::string keys_folder;         ///< for Task::make_keys
  bool json = false;               ///< for Task::check
  std::optional<int> exit_status;  ///< --help, --version or a mistake was answered already
};

CommandLine read_coupler_command_line(int argc, char** argv);

}  // namespace fpi
