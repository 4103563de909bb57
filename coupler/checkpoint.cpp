#include "checkpoint.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "core/version.hpp"
#include "output/h5_file.hpp"
#include "output/replace.hpp"

namespace fpi {
namespace {

std::string file_in(const std::string& folder) { return folder + "/checkpoint.h5"; }

std::vector<std::string> origin(std::uint64_t fingerprint) {
  return {version, fmt::format("{:016x}", fingerprint)};
}

}  // namespace

void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint, std::uint64_t fingerprint) {
  const std::string path = file_in(folder), temporary = path + ".new";
  {
    output::H5File file = output::H5File::create(temporary);
    const auto put = [&file](const std::string& name, const std::vector<double>& numbers) {
      file.write(name, numbers, {numbers.size()});
    };
    file.write("/origin", origin(fingerprint));
    for (const auto& [name, numbers] : checkpoint.simulation) put("/simulation/" + name, numbers);
    put("/time_window", checkpoint.time_window);
    put("/statistics", checkpoint.statistics);
    put("/file_sizes", checkpoint.file_sizes);
    for (const auto& [role, bytes] : checkpoint.participants) file.write("/participants/" + role, bytes);
    file.flush();
  }
  output::replace_file(temporary, path);
}

Checkpoint read_checkpoint(const std::string& folder, std::uint64_t fingerprint) {
  const std::string path = file_in(folder);
  require(std::filesystem::exists(path),
          "a checkpoint is required to resume; {} is not there: set output.checkpoint_every in the scene and "
          "run again",
          path);
  const output::H5File file = output::H5File::read(path);
  require(file.texts("/origin") == origin(fingerprint),
          "a checkpoint of this very scene and of version {} is required to resume; {} is of another: start "
          "a new run",
          version, path);
  Checkpoint checkpoint;
  for (const std::string& name : file.list("/simulation")) {
    checkpoint.simulation[name] = file.doubles("/simulation/" + name);
  }
  checkpoint.time_window = file.doubles("/time_window");
  checkpoint.statistics = file.doubles("/statistics");
  checkpoint.file_sizes = file.doubles("/file_sizes");
  if (file.has("/participants")) {
    for (const std::string& role : file.list("/participants")) {
      checkpoint.participants[role] = file.bytes("/participants/" + role);
    }
  }
  return checkpoint;
}

}  // namespace fpi
