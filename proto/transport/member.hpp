/// A participant as the coupler knows it, and the rules by which it becomes one.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "proto/host_options.hpp"
#include "proto/messages.hpp"
#include "proto/transport/socket.hpp"

namespace fpi::proto {

/// A participant that was welcomed.
struct Member {
  Hello hello{};
  std::string peer{};    ///< routing id of its connection
  double last_seen = 0;  ///< [s] by the coupler's AttentiveClock
  std::string phase = "start";
  Stamp stamp{};                      ///< of the last request
  const char* asked = "nothing yet";  ///< name of the last request
  std::optional<Message> answer{};    ///< to it
  std::optional<double> ending{};     ///< [s] since when we know that it has ended
  bool gone = false;
  Figures last_figures{};

  /// E.g. "fluid (fluid_server 0.1.0)".
  std::string who() const;
  /// E.g. "in phase "factor" of step 12, sub-iteration 3".
  std::string where() const;
  /// What is wrong with an answer that belongs to another request.
  std::string foreign(const Stamp& theirs, const Message& message) const;
};
using Members = std::map<std::string, Member>;  ///< by role

/// Why a program cannot take part in a run that needs `roles` and has `members`; "" where it can.
std::string objection(const Hello& hello, const std::vector<std::string>& roles, const Members& members,
                      const HostOptions& options);

}  // namespace fpi::proto
