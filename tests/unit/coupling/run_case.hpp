/// What tests of the run loop share: a scene, and participants in this process.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "../temporary_folder.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "fakes.hpp"
#include "output/h5_file.hpp"
#include "output/table.hpp"
#include "results/extrema.hpp"
#include "run/time_loop.hpp"
#include "setup/plan.hpp"

namespace fpi {

using CoupledRun = fpi::TimeLoop;  // testing::Test has a Run of its own

inline constexpr double gravity = -9.81;

inline scene::Body disc(const std::string& name, const std::string& motion) {
  scene::Body body;
  body.name = name;
  body.radius = 0.5;
  body.density = 4 / std::numbers::pi;  // mass 1
  body.position = {0, 3};
  body.motion = motion;
  if (motion == "prescribed") body.prescribed_velocity = {"cos(t)", "0"};
  return body;
}

inline scene::Scene make_scene(const std::vector<scene::Body>& bodies) {
  scene::Scene scene;
  scene.gravity = {0, gravity};
  scene.time.step = 0.1;
  scene.time.end = 1.2;
  scene.bodies = bodies;
  scene.fluid.emplace();
  scene.fluid->density = 1;
  scene.fluid->dynamic_viscosity = 1;
  scene.fluid->mesh.lower = {0, 0};
  scene.fluid->mesh.upper = {1, 1};
  scene.fluid->mesh.cells_x = scene.fluid->mesh.cells_y = 1;
  return scene;
}

struct RunTest : testing::Test {
  TemporaryFolder folder;
  Timers timers;
  FakeFluid fluid;
  FakeDem dem;

  /// Bodies that fall start from `places` [m].
  explicit RunTest(const std::vector<proto::Vec3>& places = {{0, 3, 0}}) : dem(new_dem(places)) {}

  static FakeDem new_dem(const std::vector<proto::Vec3>& places = {{0, 3, 0}}) {
    std::vector<proto::Motion> motions;
    for (std::uint32_t i = 0; i < places.size(); ++i) motions.push_back({.body = i, .position = places[i]});
    return {1, gravity, motions};
  }
  CoupledRun make_run(const scene::Scene& scene) {
    return CoupledRun(scene, {scene.fluid ? &fluid : nullptr, scene.needs_dem() ? &dem : nullptr},
                      folder.path(), 1, timers);
  }
  /// The newest checkpoint; that of the end is the last.
  Checkpoint newest_checkpoint(const scene::Scene& scene) {
    return read_checkpoint(folder.path(), inputs_up_to_any_end(scene, {}));
  }
  Checkpoint last_checkpoint_before_the_end(const scene::Scene& scene) {
    discard_newest_checkpoint(folder.path());
    return newest_checkpoint(scene);
  }
  std::size_t history_lines() {
    const std::string text = read_text_file(folder / "history.csv");
    return static_cast<std::size_t>(std::ranges::count(text, '\n')) - 1;
  }
};

}  // namespace fpi
