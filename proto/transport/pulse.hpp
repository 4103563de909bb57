/// Whether the coupler lives, however busy it is: a second connection that carries nothing but ZeroMQ's own
/// pings, which the ZeroMQ threads of the coupler answer.
#pragma once

#include "proto/participant.hpp"
#include "proto/transport/socket.hpp"

namespace fpi::proto {

class Pulse {
 public:
  /// Feels for a coupler that has vanished when nothing came for `silence_timeout` [s].
  Pulse(zmq::context_t& context, const Connection& connection, double silence_timeout);
  /// True once it has vanished.
  bool has_stopped();

 private:
  zmq::socket_t connection_, monitor_;
};

}  // namespace fpi::proto
