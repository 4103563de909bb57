#include "proto/transport/security.hpp"

#include <algorithm>

#include "core/log.hpp"
#include "proto/keys.hpp"

namespace fpi::proto {
namespace {

void set_pair(zmq::socket_t& socket, const std::string& keys, const std::string& owner) {
  socket.set(zmq::sockopt::curve_publickey, read_key(keys, owner + ".public"));
  socket.set(zmq::sockopt::curve_secretkey, read_key(keys, owner + ".secret"));
}

}  // namespace

void secure_coupler(zmq::socket_t& socket, const std::string& keys) {
  set_pair(socket, keys, "coupler");
  socket.set(zmq::sockopt::curve_server, true);
  socket.set(zmq::sockopt::zap_domain, "fpi");
}

void secure_participant(zmq::socket_t& socket, const std::string& keys) {
  set_pair(socket, keys, "participant");
  socket.set(zmq::sockopt::curve_serverkey, read_key(keys, "coupler.public"));
}

Doorkeeper::Doorkeeper(zmq::context_t& context, const std::string& keys) : socket_(context, ZMQ_ROUTER) {
  zmq_z85_decode(admitted_.data(), read_key(keys, "participant.public").c_str());
  socket_.set(zmq::sockopt::linger, 0);
  socket_.bind("inproc://zeromq.zap.01");
}

void Doorkeeper::answer() {
  // Asker, empty, version, request, domain, address, identity, mechanism; then the credentials: CURVE has its
  // key.
  enum { asker, empty, version, request, domain, address, identity, mechanism, key, n_frames };
  while (auto question = receive(socket_)) {
    Frames& q = *question;
    if (q.size() < n_frames) continue;
    const bool known = q[mechanism].to_string_view() == "CURVE" && q[key].size() == admitted_.size() &&
                       std::equal(admitted_.begin(), admitted_.end(), q[key].data<std::uint8_t>());
    if (!known) log::warning("refused {}: its key is not participant.public", q[address].to_string_view());
    Frames answer;
    for (const auto part : {asker, empty, version, request}) answer.push_back(std::move(q[part]));
    for (const char* part :
         {known ? "200" : "400", known ? "OK" : "unknown key", known ? "participant" : "", ""})
      answer.emplace_back(std::string_view(part));
    send(socket_, std::move(answer));
  }
}

}  // namespace fpi::proto
