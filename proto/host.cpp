/// The coupler's end, in one thread: every wait is a sequence of turns, and a turn polls, handles what came,
/// shows that the coupler lives, and looks whether everybody else does.
#include "proto/host.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <optional>

#include "core/log.hpp"
#include "proto/codec.hpp"
#include "proto/transport/address.hpp"
#include "proto/transport/exits.hpp"
#include "proto/transport/security.hpp"
#include "proto/transport/socket.hpp"

namespace fpi::proto {
namespace {

constexpr double last_words = 0.5;        ///< [s] for the last messages and the exit status of who has ended
constexpr double farewell_limit = 5;      ///< [s] for all participants to end
constexpr double display_interval = 0.1;  ///< [s]
constexpr std::array<std::string_view, 2> known_roles{"fluid", "dem"};

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "it is set in a signal handler");

/// A participant that was welcomed.
struct Member {
  std::string role, peer;  ///< peer: routing id of its connection
  Hello hello;
  Clock::time_point last_seen = Clock::now();
  std::string phase = "start";
  Stamp stamp;                              ///< of the last request
  const char* asked = "nothing yet";        ///< name of the last request
  std::optional<Message> answer;            ///< to it
  std::optional<Clock::time_point> ending;  ///< since when we know that it has ended
  bool gone = false;
  Figures last_figures;

  std::string who() const { return fmt::format("{} ({} {})", role, hello.program, hello.program_version); }
  std::string where() const {
    return stamp.step == 0 ? fmt::format("in phase \"{}\", before the first step", phase)
                           : fmt::format("in phase \"{}\" of step {}, sub-iteration {}", phase, stamp.step,
                                         stamp.sub_iteration);
  }
};

}  // namespace

struct Host::Implementation {
  explicit Implementation(const HostOptions& o) : options(o) {}

  HostOptions options;
  zmq::context_t context;
  std::optional<Doorkeeper> doorkeeper;
  zmq::socket_t router{context, ZMQ_ROUTER};
  Exits exits;
  std::vector<std::string> roles;              ///< that the scene needs
  std::map<std::string, Member> members;       ///< by role
  std::map<std::string, std::string> refused;  ///< why, by role; for the error when nobody joins
  Clock::time_point last_beat{}, last_display{};

  void bind();
  void start_waiting();
  void turn(const std::function<void()>& while_waiting);
  void handle(Frames frames);
  void handle_stranger(const std::string& peer, const std::variant<Envelope, Malformed>& letter);
  void handle_member(Member& member, Envelope envelope);
  std::string objection(const Hello& hello) const;
  void welcome(const std::string& peer, const Hello& hello);
  void refuse(const std::string& peer, const std::string& role, const std::string& reason);
  void beat();
  void look_after(Member& member);
  bool send_to(Member& member, const Envelope& envelope);
  Member* member_at(std::string_view peer);
  [[noreturn]] void lose(Member& member, const std::string& what);
};

// ---- a turn -------------------------------------------------------------------------------------

void Host::Implementation::bind() {
  require_usable(options.address, options.keys);
  set_limits(router);
  router.set(zmq::sockopt::router_mandatory, true);
  router.set(zmq::sockopt::ipv6, options.address.find('[') != std::string::npos);
  if (!options.keys.empty()) {
    doorkeeper.emplace(context, options.keys);
    secure_coupler(router, options.keys);
  }
  try {
    router.bind(options.address);
  } catch (const zmq::error_t& e) {
    fail("an address of this machine that is free is required; got {} ({}): take another port, or * for any",
         options.address, e.what());
  }
}

/// Between waits nothing is read, so silence counts from the start of a wait.
void Host::Implementation::start_waiting() {
  for (auto& [role, member] : members) member.last_seen = Clock::now();
}

void Host::Implementation::turn(const std::function<void()>& while_waiting) {
  std::vector<zmq_pollitem_t> items{reading(router)};
  if (doorkeeper) items.push_back(reading(doorkeeper->socket()));
  const bool watch = options.watch_stdin && !exits.launcher_gone();
  if (watch) items.push_back({nullptr, STDIN_FILENO, ZMQ_POLLIN, 0});
  poll(items, std::min(options.heartbeat_interval, display_interval) / 2);

  if (doorkeeper) doorkeeper->answer();
  if (watch && items.back().revents != 0) exits.read();
  if (auto frames = receive(router)) handle(std::move(*frames));
  beat();
  for (auto& [role, member] : members) look_after(member);
  if (while_waiting && since(last_display) > display_interval) {
    last_display = Clock::now();
    while_waiting();
  }
  if (interrupted.exchange(false)) throw Interrupted("interrupted by a signal");
  if (watch && exits.launcher_gone()) throw Interrupted("the launcher is gone");
}

void Host::Implementation::handle(Frames frames) {
  const std::string peer = frames[0].to_string();
  auto letter = frames.size() == 2
                    ? decode({frames[1].data<std::uint8_t>(), frames[1].size()})
                    : Malformed{fmt::format("a message has one frame; got {}", frames.size() - 1)};
  Member* member = member_at(peer);
  if (!member) return handle_stranger(peer, letter);
  if (const auto* malformed = std::get_if<Malformed>(&letter))
    lose(*member, fmt::format("sent a message that cannot be used ({})", malformed->reason));
  handle_member(*member, std::move(std::get<Envelope>(letter)));
}

void Host::Implementation::handle_member(Member& member, Envelope envelope) {
  member.last_seen = Clock::now();
  auto& [stamp, message] = envelope;
  if (const auto* heartbeat = std::get_if<Heartbeat>(&message)) {
    member.phase = heartbeat->phase;
  } else if (const auto* failure = std::get_if<Failure>(&message)) {
    member.phase = failure->phase;
    lose(member, fmt::format("reported an error: {}", failure->text));
  } else if (auto* farewell = std::get_if<Farewell>(&message)) {
    member.last_figures = std::move(farewell->figures);
    member.gone = true;
  } else if (stamp == member.stamp) {
    member.answer = std::move(message);
  } else {
    log::debug("dropped a late {} of {}", name(message), member.who());
  }
}

/// Shows every participant that the coupler lives, and notices who has closed its connection.
void Host::Implementation::beat() {
  if (since(last_beat) < options.heartbeat_interval) return;
  last_beat = Clock::now();
  for (auto& [role, member] : members)
    if (!member.gone) send_to(member, {member.stamp, Heartbeat{}});
}

/// Loses a member that has ended, once its last words had time to arrive, or that has been silent for too
/// long.
void Host::Implementation::look_after(Member& member) {
  if (member.gone) return;
  const std::optional<int> status = exits.of(member.role);
  if (status && !member.ending) member.ending = Clock::now();
  if (member.ending && since(*member.ending) > last_words)
    lose(member, status ? describe_exit(*status) : "has closed its connection");
  if (since(member.last_seen) > options.silence_timeout)
    lose(member, fmt::format("gave no sign of life for {} s", options.silence_timeout));
}

void Host::Implementation::lose(Member& member, const std::string& what) {
  member.gone = true;
  throw ParticipantLost(fmt::format("{} {}, {}", member.who(), what, member.where()));
}

bool Host::Implementation::send_to(Member& member, const Envelope& envelope) {
  Frames frames;
  frames.emplace_back(member.peer);
  frames.emplace_back(encode(envelope));
  const Sent sent = send(router, std::move(frames));
  if (sent == Sent::nobody && !member.ending) member.ending = Clock::now();
  return sent == Sent::yes;
}

Member* Host::Implementation::member_at(std::string_view peer) {
  for (auto& [role, member] : members)
    if (member.peer == peer) return &member;
  return nullptr;
}

// ---- joining ------------------------------------------------------------------------------------

void Host::Implementation::handle_stranger(const std::string& peer,
                                           const std::variant<Envelope, Malformed>& letter) {
  if (const auto* malformed = std::get_if<Malformed>(&letter)) return refuse(peer, "?", malformed->reason);
  const Message& message = std::get<Envelope>(letter).message;
  const auto* hello = std::get_if<Hello>(&message);
  if (!hello) return refuse(peer, "?", fmt::format("a Hello must come first; got {}", name(message)));
  const std::string reason = objection(*hello);
  reason.empty() ? welcome(peer, *hello) : refuse(peer, hello->role, reason);
}

/// Why a participant cannot take part; "" where it can.
std::string Host::Implementation::objection(const Hello& hello) const {
  const auto among = [&](const auto& list) { return std::ranges::find(list, hello.role) != list.end(); };
  if (hello.protocol_version != protocol_version)
    return fmt::format("protocol version {} is required; {} speaks {}: use programs of one release",
                       protocol_version, hello.program, hello.protocol_version);
  if (hello.schema_fingerprint != schema_fingerprint())
    return fmt::format(
        "schema fingerprint {:016x} is required; {} has {:016x}: build both from the same fpi.fbs",
        schema_fingerprint(), hello.program, hello.schema_fingerprint);
  if (!among(known_roles))
    return fmt::format("a role must be one of {}; got \"{}\"", fmt::join(known_roles, ", "), hello.role);
  if (!among(roles)) return fmt::format("this scene needs no {}; leave {} out", hello.role, hello.program);
  if (const auto taken = members.find(hello.role); taken != members.end())
    return fmt::format("the role {} is taken by {}", hello.role, taken->second.who());
  if (hello.scene_fingerprint != 0 && hello.scene_fingerprint != options.scene_fingerprint)
    return fmt::format(
        "scene fingerprint {:016x} is required; {} was started for {:016x}: start it for this run",
        options.scene_fingerprint, hello.program, hello.scene_fingerprint);
  return {};
}

void Host::Implementation::welcome(const std::string& peer, const Hello& hello) {
  Member& member = members[hello.role];
  member.role = hello.role;
  member.peer = peer;
  member.hello = hello;
  member.stamp.run = options.run;
  send_to(member, {member.stamp, Welcome{options.scene_fingerprint, options.heartbeat_interval}});
  log::info("{} has joined", member.who());
}

void Host::Implementation::refuse(const std::string& peer, const std::string& role,
                                  const std::string& reason) {
  if (std::ranges::find(roles, role) != roles.end()) refused[role] = reason;
  log::debug("refused a participant for role {}: {}", role, reason);
  Frames frames;
  frames.emplace_back(peer);
  frames.emplace_back(encode({{options.run, 0, 0}, Refusal{reason}}));
  send(router, std::move(frames));
}

std::vector<Hello> Host::admit(const std::vector<std::string>& roles, const std::vector<bool>& external) {
  require(roles.size() == external.size(), "each of {} roles must be external or not; got {}", roles.size(),
          external.size());
  Implementation& self = *implementation_;
  self.roles = roles;
  self.start_waiting();
  const Clock::time_point start = Clock::now();
  std::map<std::string, Clock::time_point> ended;
  const auto because = [&](const std::string& role) {
    const auto found = self.refused.find(role);
    return found == self.refused.end() ? std::string() : "; it was refused: " + found->second;
  };
  while (self.members.size() < roles.size()) {
    self.turn(while_waiting);
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (external[i] || self.members.contains(roles[i])) continue;
      const std::optional<int> status = self.exits.of(roles[i]);
      if (status && since(ended.try_emplace(roles[i], Clock::now()).first->second) > last_words)
        throw ParticipantLost(fmt::format("{} {} before it joined{}: see its log", roles[i],
                                          describe_exit(*status), because(roles[i])));
      if (since(start) > self.options.join_timeout)
        throw ParticipantLost(fmt::format("{} did not join at {} within {} s{}", roles[i], address(),
                                          self.options.join_timeout, because(roles[i])));
    }
  }
  std::vector<Hello> hellos;
  for (const std::string& role : roles) hellos.push_back(self.members.at(role).hello);
  return hellos;
}

// ---- asking -------------------------------------------------------------------------------------

Host::Host(const HostOptions& options) : implementation_(std::make_unique<Implementation>(options)) {
  implementation_->bind();
}
Host::~Host() = default;

std::string Host::address() const { return implementation_->router.get(zmq::sockopt::last_endpoint); }

Message Host::exchange(const std::string& role, const Stamp& stamp, Message message) {
  Implementation& self = *implementation_;
  const auto found = self.members.find(role);
  require(found != self.members.end(), "a role that has joined must be asked; got \"{}\"", role);
  Member& member = found->second;
  member.stamp = {self.options.run, stamp.step, stamp.sub_iteration};
  member.asked = name(message);
  member.answer.reset();
  self.start_waiting();
  if (member.gone) throw ParticipantLost(fmt::format("{} is gone, {}", member.who(), member.where()));
  self.send_to(member, {member.stamp, std::move(message)});
  while (!member.answer) self.turn(while_waiting);
  return std::move(*member.answer);
}

std::string Host::unexpected(const std::string& role, const Message& answer) const {
  const Member& member = implementation_->members.at(role);
  return fmt::format("{} answered {} with {}, which is no answer to it, {}", member.who(), member.asked,
                     name(answer), member.where());
}

std::vector<std::pair<std::string, Figures>> Host::dismiss(const std::string& reason) noexcept {
  std::vector<std::pair<std::string, Figures>> figures;
  try {
    Implementation& self = *implementation_;
    self.start_waiting();
    for (auto& [role, member] : self.members)
      if (!member.gone) self.send_to(member, {member.stamp, Goodbye{reason}});
    const Clock::time_point start = Clock::now();
    const auto all_gone = [&] {
      return std::ranges::all_of(self.members, [](auto& m) { return m.second.gone; });
    };
    while (!all_gone() && since(start) < farewell_limit) {
      try {
        self.turn(nullptr);
      } catch (const Error& e) {
        log::debug("while ending: {}", e.what());
      }
    }
    for (auto& [role, member] : self.members) figures.emplace_back(role, std::move(member.last_figures));
    self.members.clear();
  } catch (const std::exception& e) {
    log::warning("the run could not be ended in order: {}", e.what());
  }
  return figures;
}

void Host::interrupt() noexcept { interrupted = true; }

}  // namespace fpi::proto
