/// Which participants a scene needs, how each is started, and which scenes come before: read by the launcher.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "setup/inputs.hpp"
#include "setup/stage.hpp"

namespace fpi {

struct PlannedParticipant {
  std::string role;       ///< "fluid" | "dem"
  std::string command;    ///< "" takes our own program
  bool external = false;  ///< started by hand
};

struct Plan {
  std::string title;
  std::uint64_t scene_fingerprint = 0;  ///< of the scene and its files, see inputs.hpp
  std::vector<PlannedParticipant> participants;
  std::vector<Stage> stages;  ///< to be run before, unless they are ready
};

std::vector<PlannedParticipant> planned_participants(const scene::Scene& scene);
/// `files` are those that the scene names and that are there already.
Plan make_plan(const StagedScene& staged, const Files& files);

}  // namespace fpi
