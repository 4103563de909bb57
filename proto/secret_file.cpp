#include "proto/secret_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace fpi::proto {
namespace {

constexpr mode_t others = S_IRWXG | S_IRWXO;

/// An open file; closed with its scope.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags, mode_t mode = 0)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool is_open() const { return number_ >= 0; }
  int number() const { return number_; }
  bool close() {
    const bool closed = number_ < 0 || ::close(number_) == 0;
    number_ = -1;
    return closed;
  }

 private:
  int number_;
};

struct stat status_of(const Descriptor& file, const std::string& path) {
  require(file.is_open(), "the file {} is required and cannot be read: {}", path, std::strerror(errno));
  struct stat status {};
  require(::fstat(file.number(), &status) == 0 && S_ISREG(status.st_mode),
          "a regular file is required; {} is none", path);
  return status;
}

Descriptor open_to_read(const std::string& path) {
  return Descriptor(path, O_RDONLY | O_NONBLOCK);  // a FIFO must not be waited for
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view space = " \t\r\n";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(space) - first + 1);
}

std::string text_of(const Descriptor& file, const std::string& path) {
  std::array<char, 1024> text{};
  const ssize_t length = ::read(file.number(), text.data(), text.size());
  require(length >= 0, "{} could not be read: {}", path, std::strerror(errno));
  require(static_cast<std::size_t>(length) < text.size(),
          "a key of less than {} B is required; {} is longer: it is another file", text.size(), path);
  return std::string(trimmed({text.data(), static_cast<std::size_t>(length)}));
}

}  // namespace

void write_new(const std::string& path, std::string_view text, mode_t mode) {
  // Not O_TRUNC: a file that is there may be open to others, or be a link.
  Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL, mode);
  require(file.is_open(), "a file that can be made is required; got {} ({})", path, std::strerror(errno));
  const ssize_t written = ::write(file.number(), text.data(), text.size());
  require(written == static_cast<ssize_t>(text.size()) && file.close(), "{} could not be written: {}", path,
          std::strerror(errno));
}

bool is_open_to_others(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && (status.st_mode & others) != 0;
}

std::string read_secret(const std::string& path) {
  const Descriptor file = open_to_read(path);
  const mode_t mode = status_of(file, path).st_mode;
  require((mode & others) == 0,
          "a secret that its owner alone can read is required; {0} has mode {1:04o}: chmod 600 {0}", path,
          mode & 07777u);
  return text_of(file, path);
}

std::string read_public(const std::string& path) {
  const Descriptor file = open_to_read(path);
  status_of(file, path);
  return text_of(file, path);
}

}  // namespace fpi::proto
