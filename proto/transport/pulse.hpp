/// Whether the coupler lives, however busy it is: a second connection that carries nothing but ZeroMQ's own
/// pings, which the ZeroMQ threads of the coupler answer.
#pragma once

#include <optional>

#include "proto/connection.hpp"
#include "proto/transport/attentive_clock.hpp"
#include "proto/transport/socket.hpp"

namespace fpi::proto {

class Pulse {
 public:
  /// Feels for a coupler that has vanished when nothing came for `silence_timeout` [s].
  Pulse(zmq::context_t& context, const Connection& connection, double silence_timeout);
  /// True once it has vanished; asked every turn. Where this process stood still itself, it feels anew.
  bool has_stopped();

 private:
  void begin();
  bool is_lost();

  zmq::context_t& context_;
  const Connection& connection_;
  double silence_timeout_;
  std::optional<zmq::socket_t> pings_, monitor_;
  AttentiveClock clock_;
  double begun_ = 0, missed_before_ = 0;  ///< [s] by the clock
  bool felt_ = false;                     ///< it was connected
};

}  // namespace fpi::proto
