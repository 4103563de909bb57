#include "proto/transport/switchboard.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>

#include "core/log.hpp"
#include "core/text.hpp"
#include "proto/transport/address.hpp"

namespace fpi::proto {
namespace {

constexpr double display_interval = 0.1;  ///< [s]

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "it is set in a signal handler");

const HostOptions& checked(const HostOptions& options) {
  require_usable(options.address, options.keys);
  return options;
}

}  // namespace

void Switchboard::interrupt() noexcept { interrupted = true; }

Switchboard::Switchboard(const HostOptions& options)
    : options_(checked(options)), doorkeeper_(context_, options) {
  set_limits(router_);
  router_.set(zmq::sockopt::router_mandatory, true);  // say so when a peer is not there any more
  router_.set(zmq::sockopt::ipv6, options.address.find('[') != std::string::npos);
  router_.set(zmq::sockopt::handshake_ivl, static_cast<int>(options.handshake_timeout * 1000));
  secure_coupler(router_, options);
  try {
    router_.bind(options.address);
  } catch (const zmq::error_t& e) {
    fail("an address of this machine that is free is required; got {} ({}): take another port, or * for any",
         options.address, e.what());
  }
}

void Switchboard::turn(const std::function<void()>& while_waiting) {
  std::vector<zmq_pollitem_t> items{reading(router_)};
  const bool watch = options_.watch_stdin && !exits.launcher_gone();
  if (watch) items.push_back({nullptr, STDIN_FILENO, ZMQ_POLLIN, 0});
  poll(items, std::min(options_.heartbeat_interval, display_interval) / 2);

  clock.tick();
  if (watch && items.back().revents != 0) exits.read();
  if (const auto frames = receive(router_)) handle(*frames);
  beat();
  for (auto& [role, member] : members) look_after(member);
  if (while_waiting && since(last_display_) > display_interval) {
    last_display_ = Clock::now();
    while_waiting();
  }
  if (interrupted.exchange(false)) throw Interrupted("interrupted by a signal");
  if (watch && exits.launcher_gone()) throw Interrupted("the launcher is gone");
}

// ---- what comes ---------------------------------------------------------------------------------

void Switchboard::handle(const Frames& frames) {
  const std::string peer = frames[0].to_string();
  Letter letter = frames.size() == 2
                      ? decode({frames[1].data<std::uint8_t>(), frames[1].size()})
                      : Malformed{fmt::format("a message has one frame; got {}", frames.size() - 1)};
  const auto sender =
      std::ranges::find_if(members, [&](const auto& entry) { return entry.second.peer == peer; });
  sender == members.end() ? handle_stranger(peer, letter) : handle_member(sender->second, std::move(letter));
}

void Switchboard::handle_member(Member& member, Letter letter) {
  if (const auto* malformed = std::get_if<Malformed>(&letter))
    lose(member, fmt::format("sent a message that cannot be used ({})", malformed->reason));
  auto& [stamp, message] = std::get<Envelope>(letter);
  member.last_seen = clock.now();
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
    lose(member, member.foreign(stamp, message));
  }
}

void Switchboard::handle_stranger(const std::string& peer, const Letter& letter) {
  if (const auto* malformed = std::get_if<Malformed>(&letter)) return refuse(peer, "?", malformed->reason);
  const Message& message = std::get<Envelope>(letter).message;
  const auto* hello = std::get_if<Hello>(&message);
  if (!hello) return refuse(peer, "?", fmt::format("a Hello must come first; got {}", name(message)));
  const std::string reason = objection(*hello, roles_, members, options_);
  reason.empty() ? welcome(peer, *hello) : refuse(peer, hello->role, reason);
}

void Switchboard::welcome(const std::string& peer, const Hello& hello) {
  Member& member = members[hello.role];
  member.hello = hello;
  member.peer = peer;
  member.stamp.run = options_.run;
  member.last_seen = clock.now();
  send_to(member, Welcome{options_.scene_fingerprint, options_.heartbeat_interval, options_.silence_timeout});
  log::info("{} has joined", member.who());
}

void Switchboard::refuse(const std::string& peer, const std::string& role, const std::string& reason) {
  if (std::ranges::find(roles_, role) != roles_.end()) refused[role] = reason;
  if (refusals_.add())
    log::warning("refused a program for the role {}: {}{}", role, reason,
                 refusals_.count() == 1 ? "" : fmt::format(" ({} refused so far)", refusals_.count()));
  send_to(peer, {{options_.run, 0, 0}, Refusal{legible(reason)}});
}

// ---- who lives ----------------------------------------------------------------------------------

/// Shows every participant that the coupler lives, and notices who has closed its connection.
void Switchboard::beat() {
  if (since(last_beat_) < options_.heartbeat_interval) return;
  last_beat_ = Clock::now();
  for (auto& [role, member] : members)
    if (!member.gone) send_to(member, Heartbeat{});
}

void Switchboard::send_to(Member& member, const Message& message) {
  const Sent sent = send_to(member.peer, {member.stamp, message});
  if (sent == Sent::nobody && !member.ending) member.ending = clock.now();
}

Sent Switchboard::send_to(const std::string& peer, const Envelope& envelope) {
  Frames frames;
  frames.emplace_back(peer);
  frames.emplace_back(encode(envelope));
  return send(router_, std::move(frames));
}

/// Loses a member that has ended, once its last words had time to arrive, or that has been silent for too
/// long.
void Switchboard::look_after(Member& member) {
  if (member.gone) return;
  const std::optional<int> status = exits.of(member.hello.role);
  if (status && !member.ending) member.ending = clock.now();
  if (member.ending && clock.since(*member.ending) > last_words)
    lose(member, status ? describe_exit(*status) : "has closed its connection");
  if (clock.since(member.last_seen) > options_.silence_timeout)
    lose(member, fmt::format("gave no sign of life for {} s", options_.silence_timeout));
}

void Switchboard::lose(Member& member, const std::string& what) {
  member.gone = true;
  throw ParticipantLost(fmt::format("{} {}, {}", member.who(), what, member.where()));
}

}  // namespace fpi::proto
