/// What a run folder holds besides results: the scene as run with the files it names, so that the folder
/// alone is enough to resume, and no result of an older run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/findings.hpp"
#include "scene/scene.hpp"
#include "setup/stage.hpp"
#include "step/coupled_problem.hpp"

namespace fpi {

/// A file that a scene names.
struct InputFile {
  std::string name;  ///< that the scene has for it from here on: without its folder
  std::string path;
  std::string key{};  ///< of the scene that names it
};

/// What becomes of stages whose runs are not there yet.
enum class Unready { refuse, leave_out };

/// The files that the scene, read from `scene_file`, names, looked for beside it, or where its stages end.
/// From here on the scene names them without their folder. Throws Error where two would have one name.
std::vector<InputFile> find_files(StagedScene& staged, const std::string& scene_file,
                                  Unready unready = Unready::refuse);
/// The same; each that cannot be is an error of the scene.
std::vector<InputFile> find_files(StagedScene& staged, const std::string& scene_file, Unready unready,
                                  Findings& findings);
/// Throws Error where one cannot be read.
Files read_files(const std::vector<InputFile>& found, const std::string& scene_file);
/// The same; each that cannot be read is an error of the scene.
Files read_files(const std::vector<InputFile>& found, const std::string& scene_file, Findings& findings);
/// Both.
Files read_files(StagedScene& staged, const std::string& scene_file);

/// Throws Error naming a file that is in the folder of the results, where it might be overwritten.
void require_outside(const std::string& folder, const std::string& scene_file,
                     const std::vector<InputFile>& found);

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

/// Removes the results of an older run.
void clear_folder(const std::string& folder);
/// Removes the files that a killed run had not finished: none of them is a result.
void remove_unfinished(const std::string& folder);
/// Writes scene.toml and, in a folder of their own, the files that it names: no result has one of their
/// names.
void write_inputs(const std::string& folder, const scene::Scene& scene, const Files& files);

}  // namespace fpi
