/// A stage of a scene: another scene whose run ends with the packing that this one begins with.
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

/// The table that a finished stage ends with. Throws Error with the command that runs it where it is not
/// ready.
std::string table_of(const Stage& stage);

}  // namespace fpi
