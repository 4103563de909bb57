/// How the coupler's end of the wire is opened, and what its users catch.
#pragma once

#include <cstdint>
#include <string>

#include "core/error.hpp"

namespace fpi::proto {

struct HostOptions {
  std::string address = "tcp://127.0.0.1:*";  ///< "*": a free port
  std::string keys;   ///< folder of coupler.secret, coupler.public, participant.public; "": loopback only
  std::string token;  ///< of the run, which participants must show where there are no keys
  std::uint64_t run = 0;
  std::uint64_t scene_fingerprint = 0;
  double silence_timeout = 30;    ///< [s] without a sign of life; participants are told it too
  double join_timeout = 60;       ///< [s] for every participant to join; waits for ever where external
  double handshake_timeout = 10;  ///< [s] after which a connection that shows neither key nor token is closed
  double heartbeat_interval = 0.5;
  /// Read lines "exited ROLE STATUS" from standard input, written by the launcher when a process it started
  /// ends (negative: the signal). The launcher keeps it open: its end means that the launcher is gone, and
  /// the next wait throws Interrupted.
  bool watch_stdin = false;
};

/// A participant that is gone or that reported a failure. The text has its name, last phase and exit status.
class ParticipantLost : public Error {
  using Error::Error;
};
/// The user asked to stop (SIGINT, SIGTERM).
class Interrupted : public Error {
  using Error::Error;
};

}  // namespace fpi::proto
