/// What a run folder holds besides results: the scene as run with its mesh beside it, so that the folder
/// alone is enough to resume, and no result of an older run.
#pragma once

#include <string>

#include "scene/scene.hpp"
#include "simulation.hpp"

namespace fpi {

/// The mesh that `scene`, read from `scene_file`, names. Throws Error where it cannot be read.
MeshFile read_mesh(const scene::Scene& scene, const std::string& scene_file);

/// Makes the folder where it is missing. Throws Error where that is not possible.
void make_folder(const std::string& folder);

/// Removes the results of an older run; writes scene.toml and the mesh. The scene then names the mesh in the
/// folder.
void fill_folder(const std::string& folder, scene::Scene& scene, const MeshFile& mesh);

}  // namespace fpi
