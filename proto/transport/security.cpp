#include "proto/transport/security.hpp"

#include <array>
#include <cstdlib>

#include "core/error.hpp"
#include "core/log.hpp"
#include "proto/keys.hpp"

namespace fpi::proto {
namespace {

// Asker, empty, version, request, domain, address, identity, mechanism; then the credentials: the key of
// CURVE, name and password of PLAIN.
enum Question : std::size_t {
  asker,
  empty,
  zap_version,
  request,
  domain,
  address,
  identity,
  mechanism,
  credentials
};

void set_pair(zmq::socket_t& socket, const std::string& keys, const std::string& owner) {
  socket.set(zmq::sockopt::curve_publickey, read_key(keys, owner + ".public"));
  socket.set(zmq::sockopt::curve_secretkey, read_key(keys, owner + ".secret"));
}

std::string bytes_of_key(const std::string& z85) {
  std::array<char, 32> bytes{};
  zmq_z85_decode(reinterpret_cast<std::uint8_t*>(bytes.data()), z85.c_str());
  return {bytes.begin(), bytes.end()};
}

/// Takes the same time wherever two texts of one length differ, so that none can be found by trying.
bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned>(static_cast<unsigned char>(b[i]));
  return difference == 0;
}

}  // namespace

void secure_coupler(zmq::socket_t& socket, const HostOptions& options) {
  socket.set(zmq::sockopt::zap_domain, "fpi");
  if (options.keys.empty()) {
    require(!options.token.empty(), "a coupler needs keys or the token of its run; got neither");
    socket.set(zmq::sockopt::plain_server, true);
  } else {
    set_pair(socket, options.keys, "coupler");
    socket.set(zmq::sockopt::curve_server, true);
  }
}

void prepare_participant(zmq::socket_t& socket, const Connection& connection) {
  set_limits(socket);
  socket.set(zmq::sockopt::ipv6, connection.address.find('[') != std::string::npos);
  if (connection.keys.empty()) {
    require(!connection.token.empty(),
            "a participant on this machine needs the token of the run: give --token FILE, the file that the "
            "coupler wrote (.token in the folder of the run)");
    socket.set(zmq::sockopt::plain_username, "participant");
    socket.set(zmq::sockopt::plain_password, connection.token);
  } else {
    set_pair(socket, connection.keys, "participant");
    socket.set(zmq::sockopt::curve_serverkey, read_key(connection.keys, "coupler.public"));
  }
}

Doorkeeper::Doorkeeper(zmq::context_t& context, const HostOptions& options)
    : questions_(context, ZMQ_ROUTER),
      closing_(context, ZMQ_PAIR),
      close_(context, ZMQ_PAIR),
      by_key_(!options.keys.empty()),
      admitted_(by_key_ ? bytes_of_key(read_key(options.keys, "participant.public")) : options.token) {
  questions_.set(zmq::sockopt::linger, 0);
  questions_.bind("inproc://zeromq.zap.01");
  closing_.bind("inproc://closing");
  close_.connect("inproc://closing");
  thread_ = std::thread([this] { work(); });
}

Doorkeeper::~Doorkeeper() {
  try {
    close_.send(zmq::message_t(), zmq::send_flags::none);
  } catch (const zmq::error_t& e) {
    log::error("the doorkeeper cannot be sent home: {}", e.what());
    std::abort();  // joining the thread would hang
  }
  thread_.join();
}

void Doorkeeper::work() noexcept {
  constexpr double rarely = 10;  // [s]
  try {
    for (std::array items{reading(questions_), reading(closing_)}; !readable(items[1]); poll(items, rarely))
      answer_all();
  } catch (const std::exception& e) {
    log::error("nobody can join any more: {}", e.what());
  }
}

bool Doorkeeper::admits(const Frames& question) const {
  return question[mechanism].to_string_view() == (by_key_ ? "CURVE" : "PLAIN") &&
         same_secret(question.back().to_string_view(), admitted_);
}

void Doorkeeper::answer_all() {
  while (auto question = receive(questions_)) {
    if (question->size() <= credentials) continue;
    const bool admitted = admits(*question);
    if (!admitted) tell_of_refusal((*question)[address].to_string_view());
    Frames answer;
    for (const auto part : {asker, empty, zap_version, request})
      answer.push_back(std::move((*question)[part]));
    for (const char* part :
         {admitted ? "200" : "400", admitted ? "OK" : "unknown", admitted ? "participant" : "", ""})
      answer.emplace_back(std::string_view(part));
    send(questions_, std::move(answer));
  }
}

void Doorkeeper::tell_of_refusal(std::string_view peer) {
  if (!refused_.add()) return;
  log::warning("refused {}: {}{}", peer,
               by_key_ ? "its key is not participant.public" : "its token is not that of this run",
               refused_.count() == 1 ? "" : fmt::format(" ({} refused so far)", refused_.count()));
}

}  // namespace fpi::proto
