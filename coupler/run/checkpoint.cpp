#include "run/checkpoint.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/bytes.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "output/replace.hpp"

namespace fpi {
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t magic = 0x00314b4843495046;  // "FPICHK1\0"

void put_text(ByteWriter& write, std::string_view text) {
  write.put_sized({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}
std::string read_text(ByteReader& read) {
  const auto bytes = read.sized();
  return {bytes.begin(), bytes.end()};
}

void put_numbers(ByteWriter& write, const std::vector<double>& numbers) {
  write.put_sized({reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size() * sizeof(double)});
}
std::vector<double> read_numbers(ByteReader& read) {
  const auto bytes = read.sized();
  require(bytes.size() % sizeof(double) == 0, "a checkpoint must have whole numbers; got {} bytes of them",
          bytes.size());
  std::vector<double> numbers(bytes.size() / sizeof(double));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

/// `put(value)` writes the value of an entry.
template <class Map, class Put>
void put_map(ByteWriter& write, const Map& map, Put put) {
  write.put(static_cast<std::uint64_t>(map.size()));
  for (const auto& [name, value] : map) {
    put_text(write, name);
    put(value);
  }
}
template <class Map, class Take>
void read_map(ByteReader& read, Map& map, Take take) {
  const auto size = read.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < size; ++i) {
    std::string name = read_text(read);
    map.insert_or_assign(std::move(name), take());
  }
}

proto::Bytes content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return proto::Bytes{std::istreambuf_iterator<char>(file), {}};
}

void require_same(const Inputs& found, const Inputs& wanted, const std::string& path) {
  for (const auto& [name, hash] : wanted.files) {
    const auto before = found.files.find(name);
    require(before == found.files.end() || before->second == hash,
            "the input files that the run was begun with are required to resume; {} was changed since {} was "
            "written: put the old one back, or start a new run",
            name, path);
  }
  require(
      found == wanted,
      "a checkpoint of this very scene is required to resume; {} is of another: undo what was changed in the "
      "scene, or start a new run",
      path);
}

}  // namespace

std::string checkpoint_file(const std::string& folder) { return folder + "/checkpoint.bin"; }
std::string previous_checkpoint_file(const std::string& folder) {
  return folder + "/checkpoint.previous.bin";
}

bool has_checkpoint(const std::string& folder) {
  return fs::exists(checkpoint_file(folder)) || fs::exists(previous_checkpoint_file(folder));
}

proto::Bytes to_bytes(const Checkpoint& checkpoint) {
  ByteWriter write;
  const auto put = [&write](const std::vector<double>& numbers) { put_numbers(write, numbers); };
  write.put(magic);
  put_text(write, version);
  write.put(checkpoint.inputs.scene);
  put_map(write, checkpoint.inputs.files, [&write](std::uint64_t hash) { write.put(hash); });
  write.put(checkpoint.time);
  put_map(write, checkpoint.problem, put);
  put(checkpoint.time_window);
  put(checkpoint.statistics);
  put(checkpoint.file_sizes);
  put_map(write, checkpoint.participants, [&write](const proto::Bytes& state) { write.put_sized(state); });
  write.put(fnv1a(write.bytes));
  return std::move(write.bytes);
}

Checkpoint checkpoint_from_bytes(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t sum_bytes = sizeof(std::uint64_t);
  require(bytes.size() > 2 * sum_bytes, "a whole checkpoint is required; got {} bytes", bytes.size());
  const auto content = bytes.first(bytes.size() - sum_bytes);
  require(ByteReader(bytes.last(sum_bytes), "the checksum").get<std::uint64_t>() == fnv1a(content),
          "a checkpoint whose checksum is right is required; this one was damaged, or is not one");
  ByteReader read(content, "the checkpoint");
  require(read.get<std::uint64_t>() == magic, "a checkpoint is required; got another file");
  const std::string by = read_text(read);
  require(by == version, "a checkpoint of version {} of this program is required; got one of version {}",
          version, by);
  Checkpoint checkpoint;
  const auto numbers = [&read] { return read_numbers(read); };
  checkpoint.inputs.scene = read.get<std::uint64_t>();
  read_map(read, checkpoint.inputs.files, [&read] { return read.get<std::uint64_t>(); });
  checkpoint.time = read.number();
  read_map(read, checkpoint.problem, numbers);
  checkpoint.time_window = numbers();
  checkpoint.statistics = numbers();
  checkpoint.file_sizes = numbers();
  read_map(read, checkpoint.participants, [&read] {
    const auto state = read.sized();
    return proto::Bytes(state.begin(), state.end());
  });
  require(read.left() == 0, "a checkpoint is required; got {} bytes more than one has", read.left());
  return checkpoint;
}

void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint) {
  const std::string path = checkpoint_file(folder);
  const proto::Bytes bytes = to_bytes(checkpoint);
  std::ofstream file(output::temporary_name(path), std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  require(!file.fail(), "a folder that can be written is required for {}: check permissions and free space",
          path);
  if (fs::exists(path)) fs::rename(path, previous_checkpoint_file(folder));
  output::replace_file(path);
}

void discard_newest_checkpoint(const std::string& folder) {
  if (fs::exists(previous_checkpoint_file(folder)))
    fs::rename(previous_checkpoint_file(folder), checkpoint_file(folder));
  else
    fs::remove(checkpoint_file(folder));
}

std::optional<Checkpoint> read_previous_checkpoint(const std::string& folder, const Inputs& inputs) {
  const std::string path = previous_checkpoint_file(folder);
  std::optional<Checkpoint> checkpoint;
  try {
    checkpoint = checkpoint_from_bytes(content_of(path));
  } catch (const Error&) {
    return std::nullopt;
  }
  require_same(checkpoint->inputs, inputs, path);
  return checkpoint;
}

Checkpoint read_checkpoint(const std::string& folder, const Inputs& inputs) {
  const std::string newest = checkpoint_file(folder), previous = previous_checkpoint_file(folder);
  require(has_checkpoint(folder), "a checkpoint is required to resume; {} is not there", newest);
  Checkpoint checkpoint;
  try {
    checkpoint = checkpoint_from_bytes(content_of(newest));
  } catch (const Error& damaged) {
    try {
      checkpoint = checkpoint_from_bytes(content_of(previous));
    } catch (const Error& also) {
      fail("a whole checkpoint is required to resume; {}: {}; {}: {}", newest, damaged.what(), previous,
           also.what());
    }
    require_same(checkpoint.inputs, inputs, previous);
    log::warning("{} cannot be used, the checkpoint before it is: {}", newest, damaged.what());
    discard_newest_checkpoint(folder);
    return checkpoint;
  }
  require_same(checkpoint.inputs, inputs, newest);
  return checkpoint;
}

}  // namespace fpi
