#include "run/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/error.hpp"
#include "core/read_file.hpp"
#include "output/replace.hpp"
#include "proto/codec.hpp"
#include "run/json.hpp"

namespace fpi {
namespace fs = std::filesystem;

namespace {

/// The summary first: without it nothing is taken for a run that reached its end.
constexpr std::array results{
    "summary.json", "fields.h5",      "fields",        "fields.xdmf",      "bodies.h5",
    "interface.h5", "interface",      "boundaries.h5", "boundaries",       "profiles.h5",
    "profiles",     "history.csv",    "extrema.csv",   "final_bodies.csv", "left_bodies.csv",
    "sections.csv", "velocities.csv", "grains.csv",    "checkpoint.bin",   "checkpoint.previous.bin"};
constexpr const char* inputs_folder = "inputs";

proto::Bytes read_bytes(const fs::path& path, const std::string& scene_file) {
  const std::string text =
      read_file(path, proto::largest_message, fmt::format("a file that {} names", scene_file));
  return {text.begin(), text.end()};
}

/// Where the file is that the scene calls by this name; nowhere where it is the end of a stage that is to be
/// left out.
std::string place_of(const std::string& name, const std::string& scene_file, const std::vector<Stage>& stages,
                     Unready unready) {
  const auto stage = std::ranges::find(stages, name, &Stage::table);
  if (stage == stages.end()) return fs::path(scene_file).parent_path() / name;
  return stage->ready || unready == Unready::refuse ? table_of(*stage) : "";
}

bool is_in(const fs::path& path, const std::string& folder) {
  const fs::path way = fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(folder));
  return !way.empty() && *way.begin() != "..";
}

}  // namespace

std::vector<InputFile> find_files(StagedScene& staged, const std::string& scene_file, Unready unready,
                                  Findings& findings) {
  std::vector<InputFile> found;
  const auto find = [&](std::string& name) {
    const std::string path = place_of(name, scene_file, staged.stages, unready);
    name = fs::path(name).filename();
    if (path.empty()) return;
    const auto known = std::ranges::find(found, name, &InputFile::name);
    if (known == found.end()) {
      found.push_back({name, path});
    } else {
      require(known->path == path,
              "files with different names are required; {} names both {} and {}: rename one", scene_file,
              known->path, path);
    }
  };
  for (const auto& [key, name] : scene::file_keys(staged.scene)) {
    const std::size_t before = found.size();
    findings.attempt(key, [&find, &name = *name] { find(name); });
    if (found.size() > before) found.back().key = key;
  }
  return found;
}

std::vector<InputFile> find_files(StagedScene& staged, const std::string& scene_file, Unready unready) {
  Findings findings;
  std::vector<InputFile> found = find_files(staged, scene_file, unready, findings);
  findings.raise();
  return found;
}

Files read_files(const std::vector<InputFile>& found, const std::string& scene_file, Findings& findings) {
  Files files;
  for (const auto& [name, path, key] : found)
    findings.attempt(key, [&, &name = name, &path = path] {
      files.push_back({name, read_bytes(path, scene_file)});
    });
  return files;
}

Files read_files(const std::vector<InputFile>& found, const std::string& scene_file) {
  Findings findings;
  Files files = read_files(found, scene_file, findings);
  findings.raise();
  return files;
}

Files read_files(StagedScene& staged, const std::string& scene_file) {
  return read_files(find_files(staged, scene_file), scene_file);
}

void require_outside(const std::string& folder, const std::string& scene_file,
                     const std::vector<InputFile>& found) {
  const auto check = [&folder](const std::string& path) {
    require(
        !is_in(path, folder),
        "a folder for results that holds no file which the run reads is required; {} is in {}: take another "
        "folder",
        path, folder);
  };
  check(scene_file);
  for (const InputFile& file : found) check(file.path);
}

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  require(fs::is_directory(folder), "a folder for results is required; {} cannot be made: {}", folder,
          error.message());
}

FolderLock::FolderLock(const std::string& folder)
    : file_(open((folder + "/.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (file_ >= 0) close(file_);
  require(error != EWOULDBLOCK,
          "a folder in which no run is under way is required; one is in {}: wait for its end, stop it, or "
          "take another folder",
          folder);
  fail("a folder that can be written and locked is required; {}/.lock cannot be: {}", folder,
       std::strerror(error));
}

FolderLock::~FolderLock() { close(file_); }

std::optional<RunOrigin> completed_run(const std::string& folder) {
  std::error_code none;
  if (!fs::is_regular_file(folder + "/summary.json", none)) return {};
  std::ifstream file(folder + "/summary.json");
  return origin_if_completed({std::istreambuf_iterator<char>(file), {}});
}

void clear_folder(const std::string& folder) {
  for (const char* name : results) {
    std::error_code error;
    fs::remove_all(fs::path(folder) / name, error);
    require(!error, "a folder that can be written is required; {}/{} cannot be removed: {}", folder, name,
            error.message());
  }
}

void remove_unfinished(const std::string& folder) {
  std::vector<fs::path> unfinished;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == output::temporary_name("")) unfinished.push_back(entry.path());
  for (const fs::path& path : unfinished) fs::remove(path);
}

void write_inputs(const std::string& folder, const scene::Scene& scene, const Files& files) {
  const std::string inputs = fmt::format("{}/{}", folder, inputs_folder);
  if (!files.empty()) make_folder(inputs);
  for (const auto& [name, bytes] : files)
    output::replace_text(inputs + "/" + name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  scene::Scene as_run = scene;
  for (std::string* name : scene::file_names(as_run)) *name = fmt::format("{}/{}", inputs_folder, *name);
  output::replace_text(folder + "/scene.toml", scene::write_text(as_run));
}

}  // namespace fpi
