/// The onset of motion: when the first free body has moved by more than a stated part of its diameter, as in
/// a bed under a drive that grows.
#pragma once

#include <optional>
#include <vector>

#include "coupling/rigid_motion.hpp"
#include "scene/scene.hpp"

namespace fpi {

struct Onset {
  double time = 0;  ///< [s] at the end of the step
  std::size_t body = 0;
};

/// At the end of a step at `time` [s]: of the bodies farther from where the scene puts them than output.onset
/// allows the one that is the farthest, over its diameter. Nothing where the scene does not ask.
std::optional<Onset> find_onset(const scene::Scene& scene, const std::vector<coupling::RigidMotion>& motions,
                                double time);

}  // namespace fpi
