/// Hostile bytes against the reading of checkpoints: as they are, which the checksum must refuse, and with
/// the checksum that belongs to them, so that what lies behind it is reached. Built with FPI_LIBFUZZER
/// (clang) it is a libFuzzer target; by default its own main replays seeded mutations of a checkpoint.
#include <cstdint>
#include <cstdlib>

#include "checkpoint.hpp"
#include "core/bytes.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"

namespace {

fpi::proto::Bytes sealed(std::span<const std::uint8_t> content) {
  fpi::ByteWriter write;
  write.bytes.assign(content.begin(), content.end());
  write.put(fpi::fnv1a(content));
  return write.bytes;
}

void read(std::span<const std::uint8_t> bytes) {
  try {
    const fpi::Checkpoint checkpoint = fpi::checkpoint_from_bytes(bytes);
    const fpi::proto::Bytes again = fpi::to_bytes(checkpoint);
    if (fpi::to_bytes(fpi::checkpoint_from_bytes(again)) != again) std::abort();  // what is taken can be kept
  } catch (const fpi::Error&) {                                                   // an ordinary refusal
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read({data, size});
  read(sealed({data, size}));
  return 0;
}

#ifndef FPI_LIBFUZZER
#include <algorithm>
#include <random>

int main() {
  fpi::Checkpoint checkpoint{.inputs = {.scene = 7, .files = {{"t.csv", 8}, {"a.msh", 9}}},
                             .time = 0.5,
                             .simulation = {{"steps", {5}}, {"position", {1, 2, 3}}, {"left", {}}},
                             .time_window = {1, 2},
                             .statistics = {3},
                             .file_sizes = {4, 5},
                             .participants = {{"dem", {1, 2, 3}}, {"fluid", fpi::proto::Bytes(100)}}};
  fpi::proto::Bytes intact = fpi::to_bytes(checkpoint);
  intact.resize(intact.size() - sizeof(std::uint64_t));  // the checksum is made anew
  std::mt19937_64 random(192837465);
  for (int trial = 0; trial < 20000; ++trial) {
    fpi::proto::Bytes bytes = intact;
    for (std::uint64_t edits = 1 + random() % 6; edits > 0; --edits) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[at] = static_cast<std::uint8_t>(random());
          break;
        case 1:
          bytes[at] ^= static_cast<std::uint8_t>(1u << random() % 8);
          break;
        case 2:
          bytes.resize(1 + at);
          break;
        default:  // a piece of it over another place
          std::copy_n(intact.begin(), std::min(intact.size(), bytes.size() - at) / 4,
                      bytes.begin() + static_cast<std::ptrdiff_t>(at));
      }
    }
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
}
#endif
