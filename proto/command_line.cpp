/// The command line that all participants share.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "proto/serve.hpp"
#include "proto/token.hpp"

namespace fpi::proto {

Connection read_command_line(int argc, char** argv, const std::string& program,
                             const std::vector<std::string>& capabilities) {
  Connection connection;
  connection.program = program;
  connection.program_version = version;
  connection.capabilities = capabilities;
  std::string log_file, token_file;

  CLI::App app("A participant of an fpi run; the coupler tells it everything else", program);
  app.add_option("--connect", connection.address, "address of the coupler, e.g. tcp://127.0.0.1:5555")
      ->required();
  CLI::Option* token =
      app.add_option("--token", token_file, "file with the token of the run, which the coupler wrote");
  app.add_option("--keys", connection.keys,
                 "folder with participant.secret, participant.public and coupler.public (./fpi keys)")
      ->excludes(token);
  app.add_option("--log", log_file, "file that the log is written to, besides warnings on the terminal");
  app.add_option("--scene", connection.scene_fingerprint, "fingerprint of the only scene to take part in");
  app.set_version_flag("--version", version_text(program));
  constexpr int bad_options = 2;
  try {
    app.parse(argc, argv);
    if (*token) connection.token = read_token(token_file);
    log::open(program, log_file, log_file.empty() ? log::Level::info : log::Level::warning);
  } catch (const CLI::ParseError& e) {
    std::exit(app.exit(e) == 0 ? 0 : bad_options);
  } catch (const Error& e) {
    std::cerr << program << ": " << e.what() << '\n';
    std::exit(bad_options);
  }
  return connection;
}

}  // namespace fpi::proto
