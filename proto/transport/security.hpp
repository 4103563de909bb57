/// CURVE: both sides know each other by their public keys, everything between them is encrypted.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "proto/transport/socket.hpp"

namespace fpi::proto {

/// Sets the keys of the coupler's socket from the folder `keys`, before it binds. Throws Error for missing
/// keys.
void secure_coupler(zmq::socket_t& socket, const std::string& keys);
/// The same for a participant's socket, before it connects.
void secure_participant(zmq::socket_t& socket, const std::string& keys);

/// Answers ZeroMQ's question who may connect (ZAP, ZeroMQ RFC 27): the owner of participant.secret, nobody
/// else.
class Doorkeeper {
 public:
  Doorkeeper(zmq::context_t& context, const std::string& keys);
  zmq::socket_t& socket() { return socket_; }
  /// Answers the questions that wait.
  void answer();

 private:
  zmq::socket_t socket_;
  std::array<std::uint8_t, 32> admitted_{};
};

}  // namespace fpi::proto
