/// Counts what strangers can repeat at will, and says when it is due in the log: the 1st, 2nd, 4th, 8th …
/// time.
#pragma once

#include <bit>
#include <cstdint>

namespace fpi::proto {

class Tally {
 public:
  /// One more; true when it is worth a line.
  bool add() { return std::has_single_bit(++count_); }
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
};

}  // namespace fpi::proto
