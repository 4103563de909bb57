/// ZeroMQ sockets as both ends use them: whole messages, never blocking unless asked to, signals are no
/// errors.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>
#include <zmq.hpp>

namespace fpi::proto {

using Clock = std::chrono::steady_clock;
using Frames = std::vector<zmq::message_t>;

/// Seconds since `start`.
inline double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Limits on size, queues and the time that closing may take.
void set_limits(zmq::socket_t& socket);

/// The frames of the next message, none where there is none now. More than ten frames are nobody's: the rest
/// of them is dropped.
std::optional<Frames> receive(zmq::socket_t& socket);

enum class Sent { yes, no_room, nobody };
/// Sends `frames` as one message. `nobody`: a ROUTER no longer has that peer.
Sent send(zmq::socket_t& socket, Frames frames, zmq::send_flags flags = zmq::send_flags::dontwait);

/// Waits until an item is ready, `seconds` have passed, or a signal came.
void poll(std::span<zmq_pollitem_t> items, double seconds);

/// What happened to a watched connection, see zmq_socket_monitor.
struct ConnectionEvent {
  int kind = 0;              ///< ZMQ_EVENT_…
  std::uint32_t detail = 0;  ///< its value
};
/// The next event of the socket `monitor`; nothing where there is none now.
std::optional<ConnectionEvent> next_event(zmq::socket_t& monitor);

inline bool readable(const zmq_pollitem_t& item) { return item.revents & ZMQ_POLLIN; }
inline zmq_pollitem_t reading(zmq::socket_t& socket) { return {socket.handle(), 0, ZMQ_POLLIN, 0}; }

}  // namespace fpi::proto
