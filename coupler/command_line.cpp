#include "command_line.hpp"

#include <CLI/CLI.hpp>

#include "core/version.hpp"

namespace fpi {
namespace {

constexpr int usage_error = 2;

}  // namespace

CommandLine read_coupler_command_line(int argc, char** argv) {
  CommandLine line;
  RunOptions& run = line.run;
  std::string plan, check;
  bool reference = false;
  CLI::App app("Reads a scene, couples its participants and writes the results.", "coupler");
  app.set_version_flag("--version", version_text("coupler"));
  CLI::Option* scene = app.add_option("--scene", run.scene, "scene file to run");
  CLI::Option* out = app.add_option("--out", run.folder, "folder of the results");
  app.add_option("--set", run.overrides, "key=value instead of what the scene says")->allow_extra_args(false);
  app.add_option("--stages", run.stages, "folder of the runs of scenes that grains come from")
      ->capture_default_str();
  app.add_option("--listen", run.listen, "address for participants, tcp://HOST:PORT; * takes a free port");
  app.add_option("--keys", run.keys, "folder of CURVE keys; needed for an address that is not loopback");
  app.add_flag("--watch-stdin", run.watch_stdin, "read \"exited ROLE STATUS\" from standard input");
  CLI::Option* resume = app.add_flag("--resume", run.resume, "continue the run in --out at its checkpoint");
  CLI::Option* planned = app.add_option("--plan", plan, "print as JSON which participants a scene needs");
  CLI::Option* checked = app.add_option("--check", check, "check a scene");
  app.add_flag("--json", line.json, "with --check: print the report as JSON");
  app.add_flag("--reference", reference, "print all scene parameters as Markdown");
  CLI::Option* make_keys = app.add_option("--make-keys", line.keys_folder, "make CURVE keys in a folder");
  scene->needs(out)->excludes(resume);
  resume->needs(out);
  try {
    app.parse(argc, argv);
    if (*planned) {
      line.task = Task::plan;
      run.scene = plan;
    } else if (*checked) {
      line.task = Task::check;
      run.scene = check;
    } else if (reference) {
      line.task = Task::reference;
    } else if (*make_keys) {
      line.task = Task::make_keys;
    } else if (!*scene && !*resume) {
      throw CLI::RequiredError("one of --scene, --resume, --plan, --check, --reference, --make-keys");
    }
  } catch (const CLI::ParseError& e) {
    line.exit_status = app.exit(e) == 0 ? 0 : usage_error;
  }
  return line;
}

}  // namespace fpi
