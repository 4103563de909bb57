/// What a scene does beyond its own folder: programs that it starts and files that it reads elsewhere. Who
/// has a scene from somebody else wants to know before it runs.
#pragma once

#include <string>
#include <vector>

#include "setup/stage.hpp"

namespace fpi {

/// A sentence each, for the user; none of a scene that stays in its folder. Links are followed.
std::vector<std::string> beyond_folder(const StagedScene& staged, const std::string& scene_file);

}  // namespace fpi
