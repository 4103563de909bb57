/// Who is let in, and that whoever is not is told why.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <thread>

#include "parties.hpp"

namespace fpi::proto {
namespace {

using namespace parties;

HostOptions options() {
  HostOptions o = with_token();
  o.run = 77;
  o.scene_fingerprint = 0xabc;
  o.heartbeat_interval = 0.05;
  o.join_timeout = 3;
  return o;
}

Hello fluid_hello() {
  return {.role = "fluid",
          .program = "other",
          .program_version = "9",
          .schema_fingerprint = schema_fingerprint()};
}

/// The refusal that `bytes` get from a coupler that waits for a fluid.
std::string refusal_of(const std::vector<Bytes>& frames) {
  Host host(options());
  std::string reason;
  std::thread stranger([&] {
    Client client(host.address());
    for (std::size_t i = 0; i < frames.size(); ++i) client.send(frames[i], i + 1 < frames.size());
    const Message answer = client.receive();
    if (const auto* refusal = std::get_if<Refusal>(&answer)) reason = refusal->reason;
    Host::interrupt();
  });
  EXPECT_THROW(host.admit({"fluid"}, {false}), Interrupted);
  stranger.join();
  return reason;
}
std::string refusal_of(const Message& message) { return refusal_of({encode({{}, message})}); }

TEST(Joining, welcomes_a_participant_for_every_role) {
  Host host(options());
  Fluid fluid;
  Dem dem;
  Connection connection = connection_to(host.address());
  connection.scene_fingerprint = 0xabc;
  connection.capabilities = {"checkpoint"};
  auto fluid_status = serve_in_thread(fluid, connection);
  auto dem_status = serve_in_thread(dem, connection);
  const auto hellos = host.admit({"dem", "fluid"}, {false, false});
  ASSERT_EQ(hellos.size(), 2u);
  EXPECT_EQ(hellos[0].role, "dem");
  EXPECT_EQ(hellos[1].role, "fluid");
  EXPECT_EQ(hellos[1].program, "test_program");
  EXPECT_EQ(hellos[1].capabilities, std::vector<std::string>{"checkpoint"});
  host.dismiss("done");
  EXPECT_EQ(fluid_status.get(), 0);
  EXPECT_EQ(dem_status.get(), 0);
}

TEST(Joining, refuses_another_protocol_version) {
  Hello hello = fluid_hello();
  hello.protocol_version = 5;
  EXPECT_EQ(refusal_of(hello), "protocol version 4 is required; other speaks 5: use programs of one release");
}

TEST(Joining, refuses_another_schema) {
  Hello hello = fluid_hello();
  hello.schema_fingerprint ^= 1;
  EXPECT_NE(refusal_of(hello).find("build both from the same fpi.fbs"), std::string::npos);
}

TEST(Joining, refuses_another_scene) {
  Hello hello = fluid_hello();
  hello.scene_fingerprint = 0xdef;
  EXPECT_EQ(
      refusal_of(hello),
      "scene fingerprint 0000000000000abc is required; other was started for 0000000000000def: start it for "
      "this run");
}

TEST(Joining, refuses_an_unknown_role) {
  Hello hello = fluid_hello();
  hello.role = "solid";
  EXPECT_EQ(refusal_of(hello), "a role must be one of fluid, dem; got \"solid\"");
}

TEST(Joining, refuses_a_role_that_the_scene_does_not_need) {
  Hello hello = fluid_hello();
  hello.role = "dem";
  EXPECT_EQ(refusal_of(hello), "this scene needs no dem; leave other out");
}

TEST(Joining, refuses_a_request_before_hello) {
  EXPECT_EQ(refusal_of(Accept{}), "a Hello must come first; got Accept");
}

TEST(Joining, refuses_garbage) {
  EXPECT_EQ(refusal_of({Bytes(50, 0x55)}),
            "an intact message of protocol version 4 is required; got 50 B that are none");
  EXPECT_EQ(refusal_of({Bytes{}}),
            "an intact message of protocol version 4 is required; got 0 B that are none");
  EXPECT_EQ(refusal_of({Bytes(1, 1), Bytes(1, 2), Bytes(1, 3)}), "a message has one frame; got 3");
}

TEST(Joining, refuses_a_second_program_for_a_role) {
  Host host(options());
  Fluid first, second;
  auto first_status = serve_in_thread(first, connection_to(host.address()));
  host.admit({"fluid"}, {false});
  auto second_status = serve_in_thread(second, connection_to(host.address()));
  first.on_advance = [&](auto&, auto&) {
    EXPECT_EQ(second_status.get(), 2);
    return FluidAdvanced{.converged = true};
  };
  host.ask<Configured>("fluid", {}, Configure{});
  EXPECT_TRUE(host.ask<FluidAdvanced>("fluid", {77, 1, 0}, FluidAdvance{}).converged);
  host.dismiss("done");
  EXPECT_EQ(first_status.get(), 0);
}

/// A TCP connection to tcp://127.0.0.1:PORT that says nothing.
class IdleConnection {
 public:
  explicit IdleConnection(const std::string& address) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  ~IdleConnection() { ::close(socket_); }
  IdleConnection(const IdleConnection&) = delete;
  IdleConnection& operator=(const IdleConnection&) = delete;
  /// Reads to the end of what the other side says; true when it closes within `seconds`.
  bool is_closed_within(int seconds) const {
    const timeval limit{.tv_sec = seconds, .tv_usec = 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    std::array<char, 256> said{};
    ssize_t n = 0;
    while ((n = ::recv(socket_, said.data(), said.size(), 0)) > 0) {
    }
    return n == 0 || errno == ECONNRESET;
  }

 private:
  int socket_;
};

TEST(Joining, closes_connections_of_strangers_that_say_nothing) {
  HostOptions o = options();
  o.handshake_timeout = 0.3;
  Host host(o);
  const std::array<IdleConnection, 3> strangers{
      IdleConnection(host.address()), IdleConnection(host.address()), IdleConnection(host.address())};
  for (const IdleConnection& stranger : strangers) EXPECT_TRUE(stranger.is_closed_within(3));
}

TEST(Joining, ends_when_nobody_comes) {
  HostOptions o = options();
  o.join_timeout = 0.2;
  Host host(o);
  try {
    host.admit({"fluid"}, {false});
    FAIL() << "it must not wait for ever";
  } catch (const ParticipantLost& e) {
    EXPECT_NE(std::string(e.what()).find("fluid did not join at tcp://127.0.0.1:"), std::string::npos)
        << e.what();
  }
}

TEST(Joining, waits_for_external_programs_without_limit) {
  HostOptions o = options();
  o.join_timeout = 0.1;
  Host host(o);
  Fluid fluid;
  std::future<int> status;
  std::thread late([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    status = serve_in_thread(fluid, connection_to(host.address()));
  });
  EXPECT_EQ(host.admit({"fluid"}, {true}).size(), 1u);
  late.join();
  host.dismiss("done");
  EXPECT_EQ(status.get(), 0);
}

TEST(Joining, a_participant_gives_up_where_there_is_no_coupler) {
  std::string free_address;
  {
    Host host(options());
    free_address = host.address();
  }
  Fluid fluid;
  Connection connection = connection_to(free_address);
  connection.join_timeout = 0.3;
  EXPECT_EQ(serve(fluid, connection), 2);
}

TEST(Joining, refuses_an_address_that_is_taken) {
  Host first(options());
  HostOptions o = options();
  o.address = first.address();
  EXPECT_THROW(Host second(o), Error);
}

TEST(Joining, refuses_an_address_that_is_none) {
  for (const char* address : {"", "127.0.0.1:5555", "tcp://", "tcp://127.0.0.1", "udp://127.0.0.1:5555"}) {
    HostOptions o = options();
    o.address = address;
    EXPECT_THROW(Host host(o), Error) << address;
  }
}

}  // namespace
}  // namespace fpi::proto
