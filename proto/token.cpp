#include "proto/token.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/error.hpp"
#include "proto/secret_file.hpp"

namespace fpi::proto {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t n_bytes = 32;

void remove(const std::string& path) noexcept {
  std::error_code ignored;
  fs::remove(path, ignored);
}

}  // namespace

std::string make_token() {
  std::array<std::uint8_t, n_bytes> random{};
  require(getrandom(random.data(), random.size(), 0) == static_cast<ssize_t>(random.size()),
          "random numbers are required for the token of the run; the system gave none: {}",
          std::strerror(errno));
  return fmt::format("{:02x}", fmt::join(random, ""));
}

std::string read_token(const std::string& path) {
  std::string token = read_secret(path);
  const auto is_digit = [](unsigned char c) { return std::isxdigit(c) != 0; };
  require(token.size() == 2 * n_bytes && std::ranges::all_of(token, is_digit),
          "a token is {} hexadecimal digits; {} holds something else: name the file that the coupler wrote",
          2 * n_bytes, path);
  return token;
}

TokenFile::TokenFile(const std::string& folder) {
  write(fs::absolute(fs::path(folder) / ".token"));
  if (is_open_to_others(path_)) {
    remove(path_);
    write(fs::temp_directory_path() / fmt::format("fpi-{}.token", make_token()));
  }
}

TokenFile::~TokenFile() { remove(path_); }

/// A file that a coupler left that was killed makes room.
void TokenFile::write(const std::string& path) {
  path_ = path;
  remove(path_);
  write_new(path_, token_ + "\n", owner_only);
}

}  // namespace fpi::proto
