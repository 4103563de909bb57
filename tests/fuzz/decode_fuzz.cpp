/// Hostile bytes against the decoder of messages.
#include "fuzz.hpp"
#include "proto/codec.hpp"
#include "samples.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fpi::proto;
  const auto decoded = decode({data, size});
  if (const auto* envelope = std::get_if<Envelope>(&decoded))
    if (std::holds_alternative<Malformed>(decode(encode(*envelope))))
      fpi::fuzz::fault("what is taken must be fit to be passed on");
  return 0;
}

namespace fpi::fuzz {

std::vector<Bytes> seeds() {
  std::vector<Bytes> messages;
  for (const proto::Envelope& envelope : proto::samples::all()) {
    const auto message = proto::encode(envelope);
    messages.emplace_back(message.begin(), message.end());
  }
  return messages;
}

std::vector<std::string> words() { return {}; }

}  // namespace fpi::fuzz
