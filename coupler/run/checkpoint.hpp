/// Checkpoints of the whole run: what every participant needs, what the coupler needs, and of which run they
/// are. A folder holds the last two. Each is written beside and then renamed, and has a checksum: what was
/// damaged on the way, by a single bit or by more, is not taken for a state.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "setup/inputs.hpp"
#include "step/coupled_problem.hpp"

namespace fpi {

struct Checkpoint {
  Inputs inputs;    ///< up to any end
  double time = 0;  ///< [s] up to which the run had come
  NumbersByName problem;
  std::vector<double> time_window, statistics, file_sizes;
  StatesByRole participants;
};

std::string checkpoint_file(const std::string& folder);
std::string previous_checkpoint_file(const std::string& folder);
/// Whether there is one or the other.
bool has_checkpoint(const std::string& folder);

/// Writes FOLDER/checkpoint.bin. The one that was there is kept as the previous one.
void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint);

/// The previous one, if there is one, takes the place of the newest.
void discard_newest_checkpoint(const std::string& folder);

/// Reads the newest checkpoint that is whole, and logs a warning where that is the previous one, which takes
/// the place of the newest then. Throws Error where there is none, or where it is of another scene, of other
/// input files, which are named, or of another version of this program.
Checkpoint read_checkpoint(const std::string& folder, const Inputs& inputs);

/// The one before the newest; nothing where there is none that is whole. Throws Error as `read_checkpoint`
/// does.
std::optional<Checkpoint> read_previous_checkpoint(const std::string& folder, const Inputs& inputs);

proto::Bytes to_bytes(const Checkpoint& checkpoint);
/// Throws Error for bytes that are not a whole checkpoint of this version.
Checkpoint checkpoint_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace fpi
