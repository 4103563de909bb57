#include "proto/transport/socket.hpp"

#include <cerrno>
#include <cstring>

#include "proto/codec.hpp"

namespace fpi::proto {
namespace {

/// Runs a ZeroMQ call; true when it succeeded, false on `EAGAIN` and signals. Other errors are thrown.
template <class Call>
bool attempt(Call&& call) {
  try {
    return call().has_value();
  } catch (const zmq::error_t& e) {
    if (e.num() == EINTR) return false;
    throw;
  }
}

}  // namespace

void set_limits(zmq::socket_t& socket) {
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(largest_message));
  socket.set(zmq::sockopt::sndhwm, 1000);  // messages; one request and heartbeats are under way at most
  socket.set(zmq::sockopt::rcvhwm, 1000);
  socket.set(zmq::sockopt::linger, 2000);  // [ms] for the last words when a socket is closed
}

std::optional<Frames> receive(zmq::socket_t& socket) {
  constexpr std::size_t most = 10;  // of ZAP: a question with name and password
  Frames frames;
  for (bool more = true; more;) {
    zmq::message_t frame;
    if (!attempt([&] { return socket.recv(frame, zmq::recv_flags::dontwait); })) {
      if (frames.empty()) return std::nullopt;
      continue;  // a signal between two frames: messages arrive whole, so the rest is there
    }
    more = frame.more();
    if (frames.size() < most) frames.push_back(std::move(frame));
  }
  return frames;
}

Sent send(zmq::socket_t& socket, Frames frames, zmq::send_flags flags) {
  try {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto more = i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none;
      while (!attempt([&] { return socket.send(frames[i], flags | more); }))
        if (i == 0) return Sent::no_room;  // later frames follow the first one in any case
    }
  } catch (const zmq::error_t& e) {
    if (e.num() == EHOSTUNREACH) return Sent::nobody;
    throw;
  }
  return Sent::yes;
}

/// An event is a number of two bytes and a value of four, in the machine's own order.
std::optional<ConnectionEvent> next_event(zmq::socket_t& monitor) {
  const auto frames = receive(monitor);
  if (!frames) return std::nullopt;
  std::uint16_t kind = 0;
  ConnectionEvent event;
  const zmq::message_t& frame = frames->front();
  if (frame.size() < sizeof kind + sizeof event.detail) return event;
  std::memcpy(&kind, frame.data(), sizeof kind);
  std::memcpy(&event.detail, frame.data<char>() + sizeof kind, sizeof event.detail);
  event.kind = kind;
  return event;
}

void poll(std::span<zmq_pollitem_t> items, double seconds) {
  const int ready =
      zmq_poll(items.data(), static_cast<int>(items.size()), static_cast<long>(seconds * 1000) + 1);
  if (ready >= 0) return;
  if (errno != EINTR) throw zmq::error_t();
  for (zmq_pollitem_t& item : items) item.revents = 0;
}

}  // namespace fpi::proto
