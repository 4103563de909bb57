/// What the coupler tells the launcher: lines on standard output.
#pragma once

#include <cstdio>
#include <string>

namespace fpi {

/// A line that is heard at once.
inline void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

}  // namespace fpi
