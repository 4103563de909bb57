/// Takes part in a run with a solver: joining, heartbeats, checks of messages, errors, and the end.
#pragma once

#include "proto/participant.hpp"

namespace fpi::proto {

/// Takes part in one run. Returns the exit status: 0 after a goodbye, 1 after an error of this participant, 2
/// where the coupler refused or could not be reached, 3 where it vanished; each is logged with a sentence. A
/// solver that still works 2 s after the run is over is ended with its process. Signals keep their default
/// meaning; the launcher starts participants with SIGINT ignored, since Ctrl-C reaches all and the coupler
/// ends them in order.
int serve(FluidParticipant&, const Connection&);
int serve(DemParticipant&, const Connection&);

/// The command line every participant shares:
///   --connect ADDRESS [--token FILE | --keys DIR] [--log FILE] [--scene FINGERPRINT] [--version]
/// Reads the token and opens the log. Exits by itself on --help, --version and bad options (status 2).
Connection read_command_line(int argc, char** argv, const std::string& program,
                             const std::vector<std::string>& capabilities);

}  // namespace fpi::proto
