/// What the result of a run rests on: the values of its scene and the bytes of every file that it reads.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "scene/scene.hpp"
#include "step/solver_requests.hpp"

namespace fpi {

/// Hashes of them. They name no folder and no program: a run means the same wherever it is.
struct Inputs {
  std::uint64_t scene = 0;                     ///< see scene::fingerprint
  std::map<std::string, std::uint64_t> files;  ///< by name
  bool operator==(const Inputs&) const = default;
};

/// `files` are those that the scene names.
Inputs inputs_of(const scene::Scene& scene, const Files& files);
/// The same but for `time.end`, up to which a run may be resumed as far as one likes.
Inputs inputs_up_to_any_end(const scene::Scene& scene, const Files& files);

/// One number for all.
std::uint64_t fingerprint(const Inputs& inputs);

}  // namespace fpi
