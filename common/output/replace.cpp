#include "output/replace.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"

namespace fpi::output {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_to_write(const std::string& path) {
  fail("a folder that can be written is required for {}; got: {}. Check permissions and free space", path,
       std::strerror(errno));
}

/// Of a file or a folder; one that somebody else has removed meanwhile needs none.
void sync_to_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0 && errno == ENOENT) return;
  if (file < 0) fail_to_write(path);
  const bool synced = fsync(file) == 0;
  const int error = errno;
  const bool closed = close(file) == 0;
  if (!synced) errno = error;
  if (!synced || !closed) fail_to_write(path);
}

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

}  // namespace

void replace_file(const std::string& path, Durable durable) {
  const std::string temporary = temporary_name(path);
  if (durable == Durable::now) sync_to_disk(temporary);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail_to_write(path);
  if (durable == Durable::now) sync_to_disk(folder_of(path));
}

void replace_text(const std::string& path, std::string_view text, Durable durable) {
  std::ofstream file(temporary_name(path), std::ios::binary);
  file << text;
  file.close();
  if (file.fail()) fail_to_write(path);
  replace_file(path, durable);
}

void sync_folder(const std::string& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_symlink() && (entry.is_directory() || entry.is_regular_file())) sync_to_disk(entry.path());
  sync_to_disk(folder);
}

}  // namespace fpi::output
