/// What a run folder holds besides results: the scene as run with the files it names beside it, so that the
/// folder alone is enough to resume, and no result of an older run.
#pragma once

#include <optional>
#include <string>

#include "core/findings.hpp"
#include "scene/scene.hpp"
#include "simulation.hpp"
#include "stages.hpp"

namespace fpi {

/// The files that the scene, read from `scene_file`, names, looked for beside it, or where its stages end.
/// From here on the scene names them without their folder. Throws Error where one cannot be read, or where
/// two would have one name.
Files read_files(StagedScene& staged, const std::string& scene_file);

/// The same; each that cannot be read, or has another's name, is an error of the scene.
Files read_files(StagedScene& staged, const std::string& scene_file, Findings& findings);

/// Makes the folder where it is missing. Throws Error where that is not possible.
void make_folder(const std::string& folder);

/// Keeps all other runs out of a folder. The kernel lets go of it when the process ends, however it ends.
class FolderLock {
 public:
  /// Throws Error where a run in that folder is still under way.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

/// Of what the run was that reached its end in the folder; nothing where none did.
std::optional<RunOrigin> completed_run(const std::string& folder);

/// Removes the results of an older run; writes scene.toml and the files it names.
void fill_folder(const std::string& folder, const scene::Scene& scene, const Files& files);

}  // namespace fpi
