#include "core/read_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace fpi {
namespace {

const char* kind_of(mode_t mode) {
  switch (mode & S_IFMT) {
    case S_IFDIR:
      return "a folder";
    case S_IFIFO:
      return "a pipe";
    case S_IFSOCK:
      return "a socket";
    default:
      return "a device";
  }
}

/// An open file, closed in the end.
class Descriptor {
 public:
  explicit Descriptor(const std::string& path)
      : number_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

/// Up to `size` bytes; the file may have become shorter.
std::string read_up_to(int file, std::size_t size, const std::string& path) {
  std::string text(size, '\0');
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t got = read(file, text.data() + filled, size - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("a file that can be read is required; {} cannot be: {}", path, std::strerror(errno));
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  text.resize(filled);
  return text;
}

}  // namespace

std::string read_file(const std::string& path, std::size_t largest, const std::string& what) {
  const auto unreadable = [&] {
    fail("{} is required; {} cannot be read: {}", what, path, std::strerror(errno));
  };
  struct stat status {};  // seen before the file is opened, which may act on a device
  if (stat(path.c_str(), &status) != 0) unreadable();
  require(S_ISREG(status.st_mode), "{} is required; {} is {}", what, path, kind_of(status.st_mode));
  const Descriptor file(path);
  if (file < 0 || fstat(file, &status) != 0) unreadable();
  const auto size = static_cast<std::size_t>(status.st_size);
  require(size > 0, "{} is required; {} is empty", what, path);
  require(size <= largest, "{} of at most {} bytes is required; {} has {}", what, largest, path, size);
  return read_up_to(file, size, path);
}

}  // namespace fpi
