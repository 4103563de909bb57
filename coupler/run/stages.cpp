#include "run/stages.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "core/version.hpp"
#include "run/run_folder.hpp"
#include "setup/inputs.hpp"

namespace fpi {
namespace fs = std::filesystem;

namespace {

Stage stage_of(const fs::path& scene_file, const fs::path& stages_folder) {
  Stage stage{.scene = scene_file,
              .folder = stages_folder / scene_file.stem(),
              .table = scene_file.stem().string() + ".csv"};
  const scene::Scene scene = scene::read_file(stage.scene);
  require(
      std::ranges::none_of(scene.grains, &scene::Grains::is_staged),
      "a scene that others take their grains from must place its own; {} takes its from another: settle them "
      "there",
      stage.scene);
  StagedScene placed{.scene = scene, .stages = {}};
  const Files files = read_files(placed, stage.scene);
  stage.ready =
      completed_run(stage.folder) == RunOrigin{version, fingerprint(inputs_of(placed.scene, files))};
  return stage;
}

}  // namespace

StagedScene read_staged(const std::string& scene_file, const std::vector<std::string>& overrides,
                        const std::string& stages_folder) {
  return with_stages(scene::read_file(scene_file, overrides), scene_file, stages_folder);
}

StagedScene with_stages(scene::Scene scene, const std::string& scene_file, const std::string& stages_folder) {
  StagedScene staged{.scene = std::move(scene), .stages = {}};
  for (scene::Grains& group : staged.scene.grains) {
    if (!group.is_staged()) continue;
    const Stage stage = stage_of(fs::path(scene_file).parent_path() / group.file, stages_folder);
    group.generator = "csv";
    group.file = stage.table;
    if (std::ranges::find(staged.stages, stage.scene, &Stage::scene) == staged.stages.end())
      staged.stages.push_back(stage);
  }
  return staged;
}

}  // namespace fpi
