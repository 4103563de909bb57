/// What this program is: the version of the file VERSION, which decides what it can read, and the commit it
/// was built from.
#pragma once

#include <string>

namespace fpi {

inline constexpr const char* version = FPI_VERSION;
extern const char* const commit;  ///< "" where it was built from no repository

/// The text of `--version`, e.g. "coupler 0.1.0 (0123456789ab)".
inline std::string version_text(const std::string& program) {
  const std::string text = program + " " + version;
  return *commit == '\0' ? text : text + " (" + commit + ")";
}

}  // namespace fpi
