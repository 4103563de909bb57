/// The coupler's end of the wire: it binds a ROUTER, admits one participant a role, asks and gets answers,
/// and knows within seconds when a participant has vanished.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "proto/messages.hpp"

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

class Host {
 public:
  /// Binds. Throws Error for an address that is not loopback without keys, for one that cannot be bound, and
  /// where there is neither key nor token.
  explicit Host(const HostOptions&);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// The bound address, with the port found.
  std::string address() const;

  /// Waits until every role ("fluid", "dem") has said hello and was welcomed; refuses others with a sentence.
  /// `external[i]` roles are waited for without limit. Returns their hellos in the order of `roles`.
  std::vector<Hello> admit(const std::vector<std::string>& roles, const std::vector<bool>& external);

  /// Sends `message` to `role` and waits for its answer, which must be of type `Answer`.
  template <class Answer>
  Answer ask(const std::string& role, const Stamp& stamp, Message message) {
    Message answer = exchange(role, stamp, std::move(message));
    if (Answer* wanted = std::get_if<Answer>(&answer)) return std::move(*wanted);
    throw ParticipantLost(unexpected(role, answer));
  }

  /// Says goodbye to all that are there and collects their last figures, waiting a few seconds at most. Never
  /// throws.
  std::vector<std::pair<std::string, Figures>> dismiss(const std::string& reason) noexcept;

  /// Called about ten times a second while waiting; for progress display. May throw to stop the wait.
  std::function<void()> while_waiting;
  /// Set from a signal handler: the next wait throws Interrupted.
  static void interrupt() noexcept;

 private:
  Message exchange(const std::string& role, const Stamp&, Message);
  std::string unexpected(const std::string& role, const Message& answer) const;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fpi::proto
