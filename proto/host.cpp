/// Joining, asking and leaving, as the coupler sees them; the switchboard does the talking.
#include "proto/host.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "core/log.hpp"
#include "core/text.hpp"
#include "proto/codec.hpp"
#include "proto/transport/switchboard.hpp"

namespace fpi::proto {

struct Host::Implementation {
  explicit Implementation(const HostOptions& o) : options(o), board(o) {}
  const HostOptions options;
  Switchboard board;
};

Host::Host(const HostOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
Host::~Host() = default;

std::string Host::address() const { return implementation_->board.address(); }
void Host::interrupt() noexcept { Switchboard::interrupt(); }

std::vector<Hello> Host::admit(const std::vector<std::string>& roles, const std::vector<bool>& external) {
  require(roles.size() == external.size(), "each of {} roles must be external or not; got {} answers",
          roles.size(), external.size());
  Switchboard& board = implementation_->board;
  const double join_timeout = implementation_->options.join_timeout;
  const AttentiveClock& clock = board.clock;
  const double start = clock.now();
  std::map<std::string, double> ended;

  /// Gives up waiting for a program that we started and that has ended or takes too long.
  const auto give_up_late = [&](const std::string& role) {
    const auto refusal = board.refused.find(role);
    const std::string because = refusal == board.refused.end() ? "" : "; it was refused: " + refusal->second;
    const std::optional<int> status = board.exits.of(role);
    if (status && clock.since(ended.try_emplace(role, clock.now()).first->second) > last_words)
      throw ParticipantLost(fmt::format("{} {} before it joined{}", role, describe_exit(*status), because));
    if (clock.since(start) > join_timeout)
      throw ParticipantLost(
          fmt::format("{} did not join at {} within {} s{}", role, address(), join_timeout, because));
  };

  board.expect(roles);
  while (board.members.size() < roles.size()) {
    board.turn(while_waiting);
    for (std::size_t i = 0; i < roles.size(); ++i)
      if (!external[i] && !board.members.contains(roles[i])) give_up_late(roles[i]);
  }
  std::vector<Hello> hellos;
  for (const std::string& role : roles) hellos.push_back(board.members.at(role).hello);
  return hellos;
}

Message Host::exchange(const std::string& role, const Stamp& stamp, Message message) {
  Switchboard& board = implementation_->board;
  const auto found = board.members.find(role);
  require(found != board.members.end(), "a role that has joined must be asked; got \"{}\"", role);
  Member& member = found->second;
  if (member.gone)
    throw ParticipantLost(fmt::format("{} is gone since it was {}", member.who(), member.where()));
  member.stamp = {implementation_->options.run, stamp.step, stamp.sub_iteration};
  member.asked = name(message);
  member.answer.reset();
  board.send_to(member, message);
  while (!member.answer) {
    board.turn(while_waiting);
    if (member.gone)
      throw ParticipantLost(fmt::format("{} left without being asked to, {}", member.who(), member.where()));
  }
  return std::move(*member.answer);
}

std::string Host::unexpected(const std::string& role, const Message& answer) const {
  const Member& member = implementation_->board.members.at(role);
  return fmt::format("{} answered {} with {}, {}", member.who(), member.asked, name(answer), member.where());
}

std::vector<std::pair<std::string, Figures>> Host::dismiss(const std::string& reason) noexcept {
  constexpr double limit = 5;  // [s] for all participants together
  std::vector<std::pair<std::string, Figures>> figures;
  try {
    Switchboard& board = implementation_->board;
    const double start = board.clock.now();
    for (auto& [role, member] : board.members)
      board.send_to(member, Goodbye{legible(reason)});  // a lost one may hear it
    const auto is_gone = [](const auto& entry) { return entry.second.gone; };
    while (!std::ranges::all_of(board.members, is_gone) && board.clock.since(start) < limit) {
      try {
        board.turn(nullptr);
      } catch (const Error& e) {
        log::debug("while saying goodbye: {}", e.what());
      }
    }
    for (auto& [role, member] : board.members) {
      if (!member.gone) log::warning("{} did not end within {} s of the goodbye", member.who(), limit);
      figures.emplace_back(role, std::move(member.last_figures));
    }
    board.members.clear();
  } catch (const std::exception& e) {
    log::warning("the run could not be ended in order: {}", e.what());
  }
  return figures;
}

}  // namespace fpi::proto
