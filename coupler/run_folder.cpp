#include "run_folder.hpp"

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
#include <map>
#include <system_error>

#include "core/error.hpp"
#include "json.hpp"
#include "output/replace.hpp"

namespace fpi {
namespace fs = std::filesystem;

namespace {

constexpr std::array results{"fields.h5",     "fields.xdmf",      "bodies.h5",
                             "interface.h5",  "history.csv",      "summary.json",
                             "checkpoint.h5", "final_bodies.csv", "left_bodies.csv"};

proto::Bytes read_bytes(const fs::path& path, const std::string& scene_file) {
  std::error_code error;
  const bool is_file = fs::is_regular_file(path, error);  // a folder opens, but reading it throws
  std::ifstream file(path, std::ios::binary);
  proto::Bytes bytes;
  if (is_file) bytes.assign(std::istreambuf_iterator<char>(file), {});
  require(is_file && (file.good() || (file.eof() && !bytes.empty())),
          "a file is required at {}, as {} names it beside itself; it is missing, empty or cannot be read",
          path.string(), scene_file);
  return bytes;
}

/// Where the file is that the scene calls by this name.
fs::path place_of(const std::string& name, const std::string& scene_file, const std::vector<Stage>& stages) {
  const auto stage = std::ranges::find(stages, name, &Stage::table);
  return stage == stages.end() ? fs::path(scene_file).parent_path() / name : fs::path(table_of(*stage));
}

}  // namespace

Files read_files(StagedScene& staged, const std::string& scene_file) {
  Findings findings;
  Files files = read_files(staged, scene_file, findings);
  findings.raise();
  return files;
}

Files read_files(StagedScene& staged, const std::string& scene_file, Findings& findings) {
  Files files;
  std::map<std::string, fs::path> paths;
  const auto read = [&](std::string& name) {
    const fs::path path = place_of(name, scene_file, staged.stages);
    name = fs::path(name).filename();
    const auto [known, is_new] = paths.emplace(name, path);
    require(known->second == path,
            "files with different names are required; {} names both {} and {}: rename one", scene_file,
            known->second.string(), path.string());
    if (is_new) files.push_back({name, read_bytes(path, scene_file)});
  };
  for (const auto& [key, name] : scene::file_keys(staged.scene))
    findings.attempt(key, [&read, &name = *name] { read(name); });
  return files;
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
  std::ifstream file(folder + "/summary.json");
  return origin_if_completed({std::istreambuf_iterator<char>(file), {}});
}

void fill_folder(const std::string& folder, const scene::Scene& scene, const Files& files) {
  for (const char* name : results) {
    std::error_code error;
    fs::remove(fs::path(folder) / name, error);
    require(!error, "a folder that can be written is required; {}/{} cannot be removed: {}", folder, name,
            error.message());
  }
  for (const auto& [name, bytes] : files)
    output::replace_text(folder + "/" + name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  output::replace_text(folder + "/scene.toml", scene::write_text(scene));
}

}  // namespace fpi
