#include "proto/transport/pulse.hpp"

#include <algorithm>

#include "proto/transport/security.hpp"

namespace fpi::proto {
namespace {

constexpr double longest_interval = 10;  ///< [s] between pings
constexpr int ends = ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL |
                     ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;

int milliseconds(double seconds) { return std::max(1, static_cast<int>(seconds * 1000)); }

}  // namespace

Pulse::Pulse(zmq::context_t& context, const Connection& connection, double silence_timeout)
    : connection_(context, ZMQ_DEALER), monitor_(context, ZMQ_PAIR) {
  if (zmq_socket_monitor(connection_.handle(), "inproc://pulse", ends) != 0) throw zmq::error_t();
  monitor_.connect("inproc://pulse");
  prepare_participant(connection_, connection);
  connection_.set(zmq::sockopt::linger, 0);
  connection_.set(zmq::sockopt::handshake_ivl, milliseconds(silence_timeout));
  connection_.set(zmq::sockopt::heartbeat_ivl, milliseconds(std::min(silence_timeout / 3, longest_interval)));
  connection_.set(zmq::sockopt::heartbeat_timeout, milliseconds(silence_timeout));
  connection_.connect(connection.address);
}

bool Pulse::has_stopped() { return receive(monitor_).has_value(); }

}  // namespace fpi::proto
