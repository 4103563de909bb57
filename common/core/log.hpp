/// Logging: one log a process, to a file and (where wanted) to the terminal. spdlog stays in the source file.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace fpi::log {

enum class Level { debug, info, warning, error };

/// Opens the log of process `name`; `file` empty means no file. Messages from `terminal` up go to stderr too.
/// Throws Error when the file cannot be written.
void open(std::string_view name, const std::string& file, Level terminal);

void write(Level level, std::string_view text);
void flush();

template <class... Args>
void debug(fmt::format_string<Args...> f, Args&&... args) {
  write(Level::debug, fmt::format(f, std::forward<Args>(args)...));
}
template <class... Args>
void info(fmt::format_string<Args...> f, Args&&... args) {
  write(Level::info, fmt::format(f, std::forward<Args>(args)...));
}
template <class... Args>
void warning(fmt::format_string<Args...> f, Args&&... args) {
  write(Level::warning, fmt::format(f, std::forward<Args>(args)...));
}
template <class... Args>
void error(fmt::format_string<Args...> f, Args&&... args) {
  write(Level::error, fmt::format(f, std::forward<Args>(args)...));
}

}  // namespace fpi::log
