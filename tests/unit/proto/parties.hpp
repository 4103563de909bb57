/// Both sides of a run inside one test: a fluid whose advance is given, served in a thread of its own; and a
/// client that sends what it likes.
#pragma once

#include <functional>
#include <future>
#include <string>
#include <zmq.hpp>

#include "proto/codec.hpp"
#include "proto/host.hpp"
#include "proto/serve.hpp"

namespace fpi::proto::parties {

class Fluid : public FluidParticipant {
 public:
  std::function<FluidAdvanced(const Stamp&, const FluidAdvance&)> on_advance = [](auto&, auto&) {
    return FluidAdvanced{.converged = true};
  };
  Configured configure(const Configure& c) override { return {.notes = {c.scene}}; }
  FluidAdvanced advance(const Stamp& s, const FluidAdvance& a) override { return on_advance(s, a); }
  Accepted accept(const Accept&) override { return {{{"accepted", 1}}}; }
  void restore() override { ++restored; }
  Figures report() override { return {{"restored", restored}}; }
  int restored = 0;
};

class Dem : public DemParticipant {
 public:
  Configured configure(const Configure&) override { return {}; }
  DemAdvanced advance(const Stamp&, const DemAdvance&) override { return {.converged = true}; }
  Accepted accept(const Accept&) override { return {}; }
  void restore() override {}
};

inline const std::string token(64, '7');

inline HostOptions with_token() {
  HostOptions options;
  options.token = token;
  return options;
}

inline Connection connection_to(const std::string& address) {
  Connection connection;
  connection.program = "test_program";
  connection.program_version = "1.2";
  connection.address = address;
  connection.token = token;
  connection.join_timeout = 5;
  return connection;
}

/// Serves in a thread; the future holds the exit status.
template <class Solver>
std::future<int> serve_in_thread(Solver& solver, const Connection& connection) {
  return std::async(std::launch::async, [&solver, connection] { return serve(solver, connection); });
}

/// Sends any bytes and reads any message; with the token of the run unless another one is given.
class Client {
 public:
  explicit Client(const std::string& address, const std::string& shown = token) {
    socket_.set(zmq::sockopt::plain_username, "client");
    socket_.set(zmq::sockopt::plain_password, shown);
    socket_.set(zmq::sockopt::linger, 0);
    socket_.set(zmq::sockopt::rcvtimeo, 3000);
    socket_.connect(address);
  }
  void send(const Bytes& bytes, bool more = false) {
    socket_.send(zmq::buffer(bytes), more ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
  /// The next message that is no heartbeat; a Failure "silence" where none comes.
  Message receive() {
    for (;;) {
      zmq::message_t frame;
      if (!socket_.recv(frame)) return Failure{.text = "silence"};
      auto decoded = decode({frame.data<std::uint8_t>(), frame.size()});
      Message message = std::get<Envelope>(decoded).message;
      if (!std::holds_alternative<Heartbeat>(message)) return message;
    }
  }

 private:
  zmq::context_t context_;
  zmq::socket_t socket_{context_, ZMQ_DEALER};
};

}  // namespace fpi::proto::parties
