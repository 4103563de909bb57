#include "setup/beyond_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "setup/plan.hpp"

namespace fpi {
namespace fs = std::filesystem;

namespace {

bool is_outside(const fs::path& file, const fs::path& folder) {
  std::error_code ignored;  // what cannot be followed is taken as it is written
  const fs::path from = fs::weakly_canonical(fs::absolute(folder), ignored);
  const fs::path to = fs::weakly_canonical(fs::absolute(file), ignored);
  const fs::path way = to.lexically_relative(from);
  return way.empty() || *way.begin() == "..";
}

std::vector<fs::path> files_of(const StagedScene& staged, const fs::path& folder) {
  std::vector<fs::path> files;
  scene::Scene scene = staged.scene;
  for (const std::string* name : scene::file_names(scene))
    if (std::ranges::find(staged.stages, *name, &Stage::table) == staged.stages.end())
      files.push_back(folder / *name);
  for (const Stage& stage : staged.stages) files.emplace_back(stage.scene);
  return files;
}

}  // namespace

std::vector<std::string> beyond_folder(const StagedScene& staged, const std::string& scene_file) {
  std::vector<std::string> sentences;
  for (const PlannedParticipant& participant : planned_participants(staged.scene))
    if (!participant.command.empty())
      sentences.push_back(
          fmt::format("starts a program for {}: `{}`", participant.role, participant.command));
  const fs::path folder = fs::path(scene_file).parent_path();
  for (const fs::path& file : files_of(staged, folder))
    if (is_outside(file, folder.empty() ? "." : folder))
      sentences.push_back(fmt::format("reads a file outside its folder: {}", file.string()));
  return sentences;
}

}  // namespace fpi
