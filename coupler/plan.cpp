#include "plan.hpp"

namespace fpi {

Plan make_plan(const StagedScene& staged, const Files& files) {
  const scene::Scene& scene = staged.scene;
  Plan plan{.title = scene.title,
            .scene_fingerprint = fingerprint(inputs_of(scene, files)),
            .participants = {},
            .stages = staged.stages};
  const auto add = [&plan](const char* role, const scene::Launch& launch) {
    plan.participants.push_back({.role = role, .command = launch.command, .external = launch.external});
  };
  if (scene.needs_fluid()) add("fluid", scene.fluid->launch);
  if (scene.needs_dem()) add("dem", scene.dem ? scene.dem->launch : scene::Launch{});
  return plan;
}

}  // namespace fpi
