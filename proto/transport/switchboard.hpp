/// The coupler's socket and who is on the other side of it. Every wait is a sequence of turns: a turn polls,
/// handles what came, shows that the coupler lives, and looks whether everybody else does.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "proto/codec.hpp"
#include "proto/host_options.hpp"
#include "proto/transport/attentive_clock.hpp"
#include "proto/transport/exits.hpp"
#include "proto/transport/member.hpp"
#include "proto/transport/security.hpp"
#include "proto/transport/socket.hpp"
#include "proto/transport/tally.hpp"

namespace fpi::proto {

class Switchboard {
 public:
  /// Binds. Throws Error for an address that cannot be used.
  explicit Switchboard(const HostOptions& options);

  std::string address() const { return router_.get(zmq::sockopt::last_endpoint); }
  /// Programs for these roles are welcome from now on.
  void expect(const std::vector<std::string>& roles) { roles_ = roles; }

  /// Throws ParticipantLost and Interrupted.
  void turn(const std::function<void()>& while_waiting);
  void send_to(Member& member, const Message& message);

  AttentiveClock clock;  ///< of turns: silence while nothing was read does not count
  Members members;
  Exits exits;
  std::map<std::string, std::string> refused;  ///< why, by role; for the error when nobody joins

  static void interrupt() noexcept;

 private:
  using Letter = std::variant<Envelope, Malformed>;
  void handle(const Frames& frames);
  void handle_member(Member& member, Letter letter);
  void handle_stranger(const std::string& peer, const Letter& letter);
  void welcome(const std::string& peer, const Hello& hello);
  void refuse(const std::string& peer, const std::string& role, const std::string& reason);
  void beat();
  void look_after(Member& member);
  Sent send_to(const std::string& peer, const Envelope& envelope);
  [[noreturn]] static void lose(Member& member, const std::string& what);

  const HostOptions options_;
  zmq::context_t context_;
  Doorkeeper doorkeeper_;
  zmq::socket_t router_{context_, ZMQ_ROUTER};
  std::vector<std::string> roles_;
  Tally refusals_;
  Clock::time_point last_beat_{}, last_display_{};
};

/// [s] that the last messages and the exit status of a program that has ended may still take to arrive.
inline constexpr double last_words = 0.5;

}  // namespace fpi::proto
