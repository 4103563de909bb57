/// Files that hold a secret: keys and tokens. They are made for their owner alone, and read only where nobody
/// else can.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

namespace fpi::proto {

inline constexpr mode_t owner_only = 0600;

/// Writes a new file that never had more rights than `mode`. Throws Error where it exists or cannot be
/// written.
void write_new(const std::string& path, std::string_view text, mode_t mode);

/// True where the group or others have any right to the file.
bool is_open_to_others(const std::string& path);

/// The text of a regular file, without white space around it. Throws Error where it is missing, is longer
/// than any key, or is open to others: then with the chmod that mends it.
std::string read_secret(const std::string& path);
/// The same of a file that anybody may read.
std::string read_public(const std::string& path);

}  // namespace fpi::proto
