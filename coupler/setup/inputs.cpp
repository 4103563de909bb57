#include "setup/inputs.hpp"

#include <fmt/format.h>

#include "core/hash.hpp"

namespace fpi {

Inputs inputs_of(const scene::Scene& scene, const Files& files) {
  Inputs inputs{.scene = scene::fingerprint(scene), .files = {}};
  for (const auto& [name, bytes] : files) inputs.files[name] = fnv1a(bytes);
  return inputs;
}

Inputs inputs_up_to_any_end(const scene::Scene& scene, const Files& files) {
  scene::Scene endless = scene;
  endless.time.end = 0;
  return inputs_of(endless, files);
}

std::uint64_t fingerprint(const Inputs& inputs) {
  std::uint64_t hash = inputs.scene;
  for (const auto& [name, of_bytes] : inputs.files)
    hash = fnv1a(fmt::format("{}:{:x};", name, of_bytes), hash);
  return hash;
}

}  // namespace fpi
