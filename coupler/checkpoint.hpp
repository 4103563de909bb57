/// A checkpoint of the whole run in one file: what every participant needs, and what the coupler needs. The
/// file is the last whole one at any moment, whatever crashes.
#pragma once

#include <string>

#include "simulation.hpp"

namespace fpi {

struct Checkpoint {
  NumbersByName simulation;
  std::vector<double> time_window, statistics, file_sizes;
  StatesByRole participants;
};

/// Writes FOLDER/checkpoint.h5; `fingerprint` of the scene goes along.
void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint, std::uint64_t fingerprint);

/// Reads it. Throws Error where there is none or where it is of another scene or another version of this
/// program.
Checkpoint read_checkpoint(const std::string& folder, std::uint64_t fingerprint);

}  // namespace fpi
