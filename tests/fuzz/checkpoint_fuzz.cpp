/// Hostile bytes against the reading of checkpoints: as they are, which the checksum must refuse, and with
/// the checksum that belongs to them, so that what lies behind it is reached.
#include <cstdint>
#include <cstdlib>

#include "core/bytes.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "fuzz.hpp"
#include "run/checkpoint.hpp"

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

namespace fpi::fuzz {

std::vector<Bytes> seeds() {
  Checkpoint checkpoint{.inputs = {.scene = 7, .files = {{"t.csv", 8}, {"a.msh", 9}}},
                        .time = 0.5,
                        .problem = {{"steps", {5}}, {"position", {1, 2, 3}}, {"left", {}}},
                        .time_window = {1, 2},
                        .statistics = {3},
                        .file_sizes = {4, 5},
                        .participants = {{"dem", {1, 2, 3}}, {"fluid", proto::Bytes(100)}}};
  Bytes whole = to_bytes(checkpoint), content = whole;
  content.resize(content.size() - sizeof(std::uint64_t));  // the target seals it anew
  return {whole, content};
}

std::vector<std::string> words() { return {}; }

}  // namespace fpi::fuzz
