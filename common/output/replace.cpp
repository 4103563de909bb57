#include "output/replace.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "core/error.hpp"

namespace fpi::output {
namespace {

/// False with errno set where the file's content cannot be brought to the disk.
bool sync_to_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool synced = fsync(file) == 0;
  return close(file) == 0 && synced;
}

}  // namespace

void replace_file(const std::string& temporary, const std::string& path) {
  require(sync_to_disk(temporary) && std::rename(temporary.c_str(), path.c_str()) == 0,
          "a folder that can be written is required for {}; got: {}. Check permissions and free space", path,
          std::strerror(errno));
}

void replace_text(const std::string& path, std::string_view text) {
  const std::string temporary = path + ".new";
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  require(!file.fail(), "a folder that can be written is required for {}: check permissions and free space",
          path);
  replace_file(temporary, path);
}

}  // namespace fpi::output
