/// Scenes that begin with the packing that another scene's run ends with, dry settling first and then the
/// flow through what settled: that other scene is a stage, run before into a folder of its own.
#pragma once

#include <string>
#include <vector>

#include "setup/stage.hpp"

namespace fpi {

/// Reads a scene whose stages are run in folders of `stages_folder`. Throws Error as scene::read_file does,
/// and for a stage that has stages itself.
StagedScene read_staged(const std::string& scene_file, const std::vector<std::string>& overrides,
                        const std::string& stages_folder);

/// The same of a scene that is read already.
StagedScene with_stages(scene::Scene scene, const std::string& scene_file, const std::string& stages_folder);

}  // namespace fpi
