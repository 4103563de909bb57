#include "proto/transport/exits.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>

#include "core/log.hpp"
#include "core/text.hpp"

namespace fpi::proto {

void Exits::read() {
  std::array<char, 4096> chunk{};
  const ssize_t n = ::read(STDIN_FILENO, chunk.data(), chunk.size());
  if (n < 0 && (errno == EINTR || errno == EAGAIN)) return;
  if (n <= 0) {
    launcher_gone_ = true;
    return;
  }
  unfinished_.append(chunk.data(), static_cast<std::size_t>(n));
  for (std::size_t end; (end = unfinished_.find('\n')) != std::string::npos; unfinished_.erase(0, end + 1))
    take_line(unfinished_.substr(0, end));
  if (unfinished_.size() > chunk.size()) unfinished_.clear();  // no line of ours is that long
}

void Exits::take_line(const std::string& line) {
  std::istringstream words(line);
  std::string verb, role;
  int status = 0;
  if (words >> verb >> role >> status && verb == "exited")
    status_[role] = status;
  else
    log::warning("a line \"exited ROLE STATUS\" was expected on standard input; got \"{}\"", legible(line));
}

std::optional<int> Exits::of(const std::string& role) const {
  const auto found = status_.find(role);
  return found == status_.end() ? std::nullopt : std::optional(found->second);
}

std::string describe_exit(int status) {
  if (status >= 0) return fmt::format("ended with exit status {}", status);
  const char* name = sigabbrev_np(-status);
  return name ? fmt::format("was killed by signal {} (SIG{})", -status, name)
              : fmt::format("was killed by signal {}", -status);
}

}  // namespace fpi::proto
