#include "proto/transport/pulse.hpp"

#include <algorithm>

#include "proto/transport/security.hpp"

namespace fpi::proto {
namespace {

constexpr double longest_interval = 10;  ///< [s] between pings
constexpr double notable = 0.1;  ///< of the timeout: a pause of one's own that may have cost an answer
constexpr int watched = ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED |
                        ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                        ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;

int milliseconds(double seconds) { return std::max(1, static_cast<int>(seconds * 1000)); }

}  // namespace

Pulse::Pulse(zmq::context_t& context, const Connection& connection, double silence_timeout)
    : context_(context), connection_(connection), silence_timeout_(silence_timeout) {
  begin();
}

void Pulse::begin() {
  monitor_.reset();
  pings_.reset();
  pings_.emplace(context_, ZMQ_DEALER);
  if (zmq_socket_monitor(pings_->handle(), "inproc://pulse", watched) != 0) throw zmq::error_t();
  monitor_.emplace(context_, ZMQ_PAIR).connect("inproc://pulse");
  prepare_participant(*pings_, connection_);
  pings_->set(zmq::sockopt::linger, 0);
  pings_->set(zmq::sockopt::heartbeat_ivl, milliseconds(std::min(silence_timeout_ / 3, longest_interval)));
  pings_->set(zmq::sockopt::heartbeat_timeout, milliseconds(silence_timeout_));
  pings_->connect(connection_.address);
  begun_ = clock_.now();
  missed_before_ = clock_.missed();
  felt_ = false;
}

bool Pulse::has_stopped() {
  clock_.tick();
  if (!is_lost()) return false;
  if (clock_.missed() - missed_before_ < notable * silence_timeout_) return true;
  begin();
  return false;
}

bool Pulse::is_lost() {
  while (const auto event = next_event(*monitor_)) {
    felt_ = event->kind == ZMQ_EVENT_HANDSHAKE_SUCCEEDED;
    if (!felt_) return true;
  }
  return !felt_ && clock_.since(begun_) > silence_timeout_;
}

}  // namespace fpi::proto
