#include "setup/plan.hpp"

namespace fpi {

std::vector<PlannedParticipant> planned_participants(const scene::Scene& scene) {
  std::vector<PlannedParticipant> participants;
  const auto add = [&participants](const char* role, const scene::Launch& launch) {
    participants.push_back({.role = role, .command = launch.command, .external = launch.external});
  };
  if (scene.needs_fluid()) add("fluid", scene.fluid->launch);
  if (scene.needs_dem()) add("dem", scene.dem ? scene.dem->launch : scene::Launch{});
  return participants;
}

Plan make_plan(const StagedScene& staged, const Files& files) {
  const scene::Scene& scene = staged.scene;
  return {.title = scene.title,
          .scene_fingerprint = fingerprint(inputs_of(scene, files)),
          .participants = planned_participants(scene),
          .stages = staged.stages};
}

}  // namespace fpi
