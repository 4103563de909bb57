/// What the launcher tells the coupler on standard input: "exited ROLE STATUS", a line for each participant
/// that it started and that ended; a negative status is the signal that killed it.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace fpi::proto {

class Exits {
 public:
  /// Reads what is there; call it when standard input is readable. Unknown lines are logged and skipped.
  void read();
  /// The exit status of a role's program, where it has ended.
  std::optional<int> of(const std::string& role) const;
  /// True once the launcher has closed its end, which it does by dying only.
  bool launcher_gone() const { return launcher_gone_; }

 private:
  void take_line(const std::string& line);

  std::string unfinished_;
  std::map<std::string, int> status_;
  bool launcher_gone_ = false;
};

/// E.g. "ended with exit status 3", "was killed by signal 9 (SIGKILL)".
std::string describe_exit(int status);

}  // namespace fpi::proto
