/// The coupler's end of the wire: it binds a ROUTER, admits one participant a role, asks and gets answers,
/// and knows within seconds when a participant has vanished.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "proto/host_options.hpp"
#include "proto/messages.hpp"

namespace fpi::proto {

class Host {
 public:
  /// Binds. Throws Error for an address that is not loopback without keys, for one that cannot be bound, and
  /// where there is neither key nor token.
  explicit Host(const HostOptions&);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// The bound address, with the port found.
  std::string address() const;

  /// Waits until every role ("fluid", "dem") has said hello and was welcomed; refuses others with a sentence.
  /// `external[i]` roles are waited for without limit. Returns their hellos in the order of `roles`.
  std::vector<Hello> admit(const std::vector<std::string>& roles, const std::vector<bool>& external);

  /// Sends `message` to `role` and waits for its answer, which must be of type `Answer`.
  template <class Answer>
  Answer ask(const std::string& role, const Stamp& stamp, Message message) {
    Message answer = exchange(role, stamp, std::move(message));
    if (Answer* wanted = std::get_if<Answer>(&answer)) return std::move(*wanted);
    throw ParticipantLost(unexpected(role, answer));
  }

  /// Says goodbye to all that are there and collects their last figures, waiting a few seconds at most. Never
  /// throws.
  std::vector<std::pair<std::string, Figures>> dismiss(const std::string& reason) noexcept;

  /// Called about ten times a second while waiting; for progress display. May throw to stop the wait.
  std::function<void()> while_waiting;
  /// Set from a signal handler: the next wait throws Interrupted.
  static void interrupt() noexcept;

 private:
  Message exchange(const std::string& role, const Stamp&, Message);
  std::string unexpected(const std::string& role, const Message& answer) const;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace fpi::proto
