#include "proto/transport/link.hpp"

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "core/error.hpp"
#include "core/log.hpp"
#include "proto/codec.hpp"
#include "proto/transport/address.hpp"
#include "proto/transport/security.hpp"

namespace fpi::proto {
namespace {

constexpr double patience = 2;            ///< [s] that a solver may go on working once the run is over
constexpr int refused = 2, vanished = 3;  ///< exit statuses, see participant.hpp

constexpr int watched_events = ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED |
                               ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                               ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;

}  // namespace

Link::Link(const Connection& connection, const std::string& role, const Progress& progress)
    : connection_(connection), role_(role), progress_(progress) {
  require_usable(connection.address, connection.keys);
  inner_.bind("inproc://answers");
  outer_.connect("inproc://answers");
  if (zmq_socket_monitor(wire_.handle(), "inproc://connection", watched_events) != 0) throw zmq::error_t();
  monitor_.connect("inproc://connection");

  prepare_participant(wire_, connection);
  try {
    wire_.connect(connection.address);
  } catch (const zmq::error_t& e) {
    fail("the address of a coupler is required; got {} ({})", connection.address, e.what());
  }
  thread_ = std::thread([this] { run(); });
}

Link::~Link() {
  try {
    outer_.send(zmq::message_t(), zmq::send_flags::none);
  } catch (const zmq::error_t& e) {
    log::error("the connection cannot be ended in order: {}", e.what());
    std::abort();  // joining the thread would hang
  }
  thread_.join();
}

Event Link::next() {
  std::unique_lock lock(mutex_);
  posted_.wait(lock, [&] { return !events_.empty(); });
  Event event = std::move(events_.front());
  events_.pop_front();
  return event;
}

void Link::answer(const Envelope& envelope) {
  outer_.send(zmq::message_t(encode(envelope)), zmq::send_flags::none);
}

// ---- the thread ---------------------------------------------------------------------------------

void Link::run() noexcept {
  try {
    while (!stopped_) turn();
  } catch (const std::exception& e) {
    post(Ending{vanished, fmt::format("the connection broke: {}", e.what())});
  }
}

void Link::turn() {
  std::array items{reading(wire_), reading(monitor_), reading(inner_)};
  poll(items, std::min(heartbeat_interval_, 0.5) / 2);
  // Messages before events: a coupler that says goodbye and closes has not vanished.
  while (const auto frames = receive(wire_)) handle(*frames);
  while (const auto event = next_event(monitor_)) handle_event(*event);
  forward_answers();
  if (pulse_ && pulse_->has_stopped()) lose("it gave no sign of life");
  beat();
  watch_the_clock();
}

void Link::forward_answers() {
  while (auto frames = receive(inner_)) {
    if (frames->front().size() == 0) {
      stopped_ = true;
    } else if (!over_ || status_ == 0) {
      wire_.set(zmq::sockopt::sndtimeo, 5000);  // [ms]; the coupler is waiting for it
      if (send(wire_, std::move(*frames), zmq::send_flags::none) != Sent::yes)
        post(Ending{vanished, "the coupler takes no answers"});
    }
  }
}

void Link::handle(const Frames& frames) {
  auto letter = decode({frames[0].data<std::uint8_t>(), frames[0].size()});
  if (const auto* malformed = std::get_if<Malformed>(&letter))
    return post(Ending{refused,
                       fmt::format("the coupler sent a message that cannot be used: {}", malformed->reason)});
  auto& envelope = std::get<Envelope>(letter);
  if (const auto* refusal = std::get_if<Refusal>(&envelope.message)) {
    post(Ending{refused, fmt::format("the coupler refused: {}", refusal->reason)});
  } else if (const auto* welcome = std::get_if<Welcome>(&envelope.message)) {
    welcomed_ = true;
    heartbeat_interval_ = welcome->heartbeat_interval;
    stamp_ = envelope.stamp;
    pulse_.emplace(context_, connection_, welcome->silence_timeout);
  } else if (!std::holds_alternative<Heartbeat>(envelope.message)) {
    stamp_ = envelope.stamp;
    post(std::move(envelope));
  }
}

void Link::handle_event(const ConnectionEvent& event) {
  if (event.kind == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) {
    if (!welcomed_) join();
  } else if (event.kind == ZMQ_EVENT_DISCONNECTED) {
    if (welcomed_) lose("its connection is closed");  // before, ZeroMQ tries again
  } else {
    post(Ending{refused, handshake_failure(event)});
  }
}

void Link::lose(const char* sign) {
  wire_.set(zmq::sockopt::linger, 0);
  post(Ending{vanished, fmt::format("the coupler vanished: {}", sign)});
}

std::string Link::handshake_failure(const ConnectionEvent& event) const {
  const auto& [address, keys] = std::tie(connection_.address, connection_.keys);
  if (event.kind == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH)
    return fmt::format(
        "the coupler at {} refused: {}", address,
        keys.empty() ? "this is not the token of its run: name the file that this coupler wrote"
                     : "it does not know this key: participant.public must be the same there as in " + keys);
  if (event.detail == ZMQ_PROTOCOL_ERROR_ZMTP_MECHANISM_MISMATCH)
    return keys.empty()
               ? fmt::format("the coupler at {} asks for keys: give --keys DIR in place of --token", address)
               : fmt::format("the coupler at {} uses no keys: give --token FILE here, or --keys DIR there",
                             address);
  return keys.empty() ? fmt::format("what listens at {} is no coupler: check the address", address)
                      : fmt::format(
                            "the key exchange with {} failed: coupler.public in {} is not that coupler's "
                            "key, or it uses none",
                            address, keys);
}

void Link::join() {
  Hello hello;
  hello.role = role_;
  hello.program = connection_.program;
  hello.program_version = connection_.program_version;
  hello.capabilities = connection_.capabilities;
  hello.schema_fingerprint = schema_fingerprint();
  hello.scene_fingerprint = connection_.scene_fingerprint;
  Frames frames;
  frames.emplace_back(encode({{}, std::move(hello)}));
  send(wire_, std::move(frames));
}

void Link::beat() {
  if (!welcomed_ || over_ || since(last_beat_) < heartbeat_interval_) return;
  last_beat_ = Clock::now();
  Frames frames;
  frames.emplace_back(
      encode({stamp_, Heartbeat{progress_.phase(), std::clamp(progress_.fraction(), 0.0, 1.0)}}));
  send(wire_, std::move(frames));
}

void Link::watch_the_clock() {
  if (!welcomed_ && !over_ && since(start_) > connection_.join_timeout)
    post(Ending{refused,
                fmt::format("no coupler welcomed this program at {} within {} s: check the address and "
                            "that the coupler runs",
                            connection_.address, connection_.join_timeout)});
  if (over_ && since(*over_) > patience) {
    log::warning("the run is over and the solver still works, in phase \"{}\": ending it", progress_.phase());
    log::flush();
    std::_Exit(status_);
  }
}

/// The first ending counts; nothing follows a goodbye.
void Link::post(Event event) {
  if (over_) return;
  const auto* ending = std::get_if<Ending>(&event);
  if (ending || std::holds_alternative<Goodbye>(std::get<Envelope>(event).message)) {
    over_ = Clock::now();
    status_ = ending ? ending->status : 0;
  }
  {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
  }
  posted_.notify_one();
}

}  // namespace fpi::proto
