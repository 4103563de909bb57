#include "core/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <vector>

#include "core/error.hpp"

namespace fpi::log {
namespace {

spdlog::level::level_enum to_spdlog(Level level) {
  switch (level) {
    case Level::debug:
      return spdlog::level::debug;
    case Level::info:
      return spdlog::level::info;
    case Level::warning:
      return spdlog::level::warn;
    case Level::error:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

}  // namespace

void open(std::string_view name, const std::string& file, Level terminal) {
  auto to_terminal = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  to_terminal->set_level(to_spdlog(terminal));
  std::vector<spdlog::sink_ptr> sinks{to_terminal};
  if (!file.empty()) {
    try {
      sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>(file));
    } catch (const spdlog::spdlog_ex& e) {
      fail("a log file that can be written is required; got {} ({}): check the folder and its permissions",
           file, e.what());
    }
  }
  auto logger = std::make_shared<spdlog::logger>(std::string(name), sinks.begin(), sinks.end());
  logger->set_level(spdlog::level::debug);
  logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %n %^%l%$: %v");
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(std::move(logger));
}

void write(Level level, std::string_view text) { spdlog::log(to_spdlog(level), "{}", text); }
void flush() { spdlog::default_logger()->flush(); }

}  // namespace fpi::log
