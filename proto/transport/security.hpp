/// Who may connect. With keys, both sides know each other by their public keys and everything between them is
/// encrypted (CURVE); without, a participant shows the token of the run (PLAIN), which never leaves this
/// machine.
#pragma once

#include <string>
#include <string_view>
#include <thread>

#include "proto/connection.hpp"
#include "proto/host_options.hpp"
#include "proto/transport/socket.hpp"
#include "proto/transport/tally.hpp"

namespace fpi::proto {

/// Sets what the coupler's socket asks of others, before it binds. Throws Error for missing keys, or where
/// there is neither key nor token.
void secure_coupler(zmq::socket_t& socket, const HostOptions& options);
/// All that a participant's socket needs before it connects: limits, family of addresses, key or token.
void prepare_participant(zmq::socket_t& socket, const Connection& connection);

/// Answers ZeroMQ's question who may connect (ZAP, ZeroMQ RFC 27): the owner of participant.secret or of the
/// token, nobody else. ZeroMQ closes the connections of all others. A thread of its own answers, however busy
/// the coupler is.
class Doorkeeper {
 public:
  Doorkeeper(zmq::context_t& context, const HostOptions& options);
  ~Doorkeeper();
  Doorkeeper(const Doorkeeper&) = delete;
  Doorkeeper& operator=(const Doorkeeper&) = delete;

 private:
  void work() noexcept;
  void answer_all();
  bool admits(const Frames& question) const;
  void tell_of_refusal(std::string_view address);

  zmq::socket_t questions_;
  zmq::socket_t closing_, close_;  ///< the thread's end, and the other, of what asks it to end
  bool by_key_;
  std::string admitted_;  ///< bytes of participant.public, or the token
  Tally refused_;
  std::thread thread_;
};

}  // namespace fpi::proto
