#include "run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/error.hpp"
#include "json.hpp"
#include "output/replace.hpp"

namespace fpi {
namespace fs = std::filesystem;

namespace {

constexpr std::array results{"fields.h5",   "fields.xdmf",  "bodies.h5",    "interface.h5",
                             "history.csv", "summary.json", "checkpoint.h5"};

}  // namespace

MeshFile read_mesh(const scene::Scene& scene, const std::string& scene_file) {
  if (!scene.fluid || scene.fluid->mesh.file.empty()) return {};
  const fs::path path = fs::path(scene_file).parent_path() / scene.fluid->mesh.file;
  std::ifstream file(path, std::ios::binary);
  MeshFile mesh{.name = path.filename(), .bytes = {std::istreambuf_iterator<char>(file), {}}};
  require(file.good() || (file.eof() && !mesh.bytes.empty()),
          "a mesh file is required at {} (fluid.mesh.file in {}, beside the scene); it is missing, empty or "
          "cannot be "
          "read",
          path.string(), scene_file);
  return mesh;
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

bool is_completed(const std::string& folder) {
  std::ifstream file(folder + "/summary.json");
  return says_completed({std::istreambuf_iterator<char>(file), {}});
}

void fill_folder(const std::string& folder, scene::Scene& scene, const MeshFile& mesh) {
  for (const char* name : results) {
    std::error_code error;
    fs::remove(fs::path(folder) / name, error);
    require(!error, "a folder that can be written is required; {}/{} cannot be removed: {}", folder, name,
            error.message());
  }
  if (!mesh.name.empty()) {
    output::replace_text(folder + "/" + mesh.name,
                         {reinterpret_cast<const char*>(mesh.bytes.data()), mesh.bytes.size()});
    scene.fluid->mesh.file = mesh.name;
  }
  output::replace_text(folder + "/scene.toml", scene::write_text(scene));
}

}  // namespace fpi
