/// CURVE keys: a folder with coupler.secret, coupler.public, participant.secret and participant.public (Z85
/// text).
#pragma once

#include <string>

namespace fpi::proto {

/// Makes both pairs in `folder` (created where missing; secrets readable by their owner only). Never
/// overwrites: throws Error when a key is there already.
void make_keys(const std::string& folder);

/// Reads a key file. Throws Error naming the file when it is missing, is not 40 characters of Z85, or is a
/// secret that others than its owner can read.
std::string read_key(const std::string& folder, const std::string& file);

}  // namespace fpi::proto
