/// Scenes that begin with the packing that another scene's run ends with, dry settling first and then the
/// flow through what settled: that other scene is a stage, run before into a folder of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace fpi {

/// What a run was made of and by.
struct RunOrigin {
  std::string version;                  ///< of this program
  std::uint64_t scene_fingerprint = 0;  ///< of the scene and its files, see inputs.hpp
  bool operator==(const RunOrigin&) const = default;
};

/// A scene that another one takes its grains from.
struct Stage {
  std::string scene;   ///< its file
  std::string folder;  ///< of its run
  std::string table;   ///< name that the other scene has for what the run ends with
  bool ready = false;  ///< the folder has a completed run of this scene as it is now, by this version
};

struct StagedScene {
  scene::Scene scene;  ///< its groups of generator "scene" are such of "csv"
  std::vector<Stage> stages;
};

/// Reads a scene whose stages are run in folders of `stages_folder`. Throws Error as scene::read_file does,
/// and for a stage that has stages itself.
StagedScene read_staged(const std::string& scene_file, const std::vector<std::string>& overrides,
                        const std::string& stages_folder);

/// The same of a scene that is read already.
StagedScene with_stages(scene::Scene scene, const std::string& scene_file, const std::string& stages_folder);

/// The table that a finished stage ends with. Throws Error with the command that runs it where it is not
/// ready.
std::string table_of(const Stage& stage);

}  // namespace fpi
