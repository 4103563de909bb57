/// Files that the user names, read as a whole. Only regular files of a limited size are: a device or a pipe
/// may keep its reader waiting, or never end.
#pragma once

#include <cstddef>
#include <string>

namespace fpi {

/// The bytes of a file that is not empty. Throws Error where it is no such file, cannot be read, or has more
/// than `largest` bytes; `what` says what is required there, e.g. "a scene file".
std::string read_file(const std::string& path, std::size_t largest, const std::string& what);

}  // namespace fpi
