/// Hostile bytes against the decoder. Built with FPI_LIBFUZZER (clang) it is a libFuzzer target; by default
/// its own main replays seeded mutations of every message, so that it never rots.
#include <cstdint>
#include <cstdlib>

#include "proto/codec.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fpi::proto;
  const auto decoded = decode({data, size});
  if (const auto* envelope = std::get_if<Envelope>(&decoded))
    if (std::holds_alternative<Malformed>(decode(encode(*envelope))))
      std::abort();  // what is taken can be passed on
  return 0;
}

#ifndef FPI_LIBFUZZER
#include <algorithm>
#include <random>

#include "samples.hpp"

int main() {
  using namespace fpi::proto;
  std::mt19937_64 random(987654321);
  for (const Envelope& envelope : samples::all()) {
    const Bytes intact = encode(envelope);
    for (int trial = 0; trial < 3000; ++trial) {
      Bytes bytes = intact;
      for (std::uint64_t edits = 1 + random() % 8; edits > 0; --edits) {
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
          default:  // a piece of the message over another place
            std::copy_n(intact.begin(), std::min(intact.size(), bytes.size() - at) / 4,
                        bytes.begin() + static_cast<std::ptrdiff_t>(at));
        }
      }
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
  }
}
#endif
