/// Which participants a scene needs, and how each is started: read by the launcher.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace fpi {

struct PlannedParticipant {
  std::string role;       ///< "fluid" | "dem"
  std::string command;    ///< "" takes our own program
  bool external = false;  ///< started by hand
};

struct Plan {
  std::string title;
  std::uint64_t scene_fingerprint = 0;
  std::vector<PlannedParticipant> participants;
};

Plan make_plan(const scene::Scene& scene);

}  // namespace fpi
