/// All that changes from step to step, and its form as bytes for checkpoints: little-endian, only this
/// program reads it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem/neighbours.hpp"

namespace fpi::dem {

struct State {
  Motions motions;
  Neighbours neighbours;
};

/// A state whose search was forgotten, as bytes.
std::vector<std::uint8_t> to_bytes(const State& state);

/// Bitwise the state that was written; a search is due. Throws Error unless the bytes are a whole state of
/// this model: as many bodies, finite numbers, unit quaternions, pairs that exist, in order.
State from_bytes(std::span<const std::uint8_t> bytes, const Model& model);

}  // namespace fpi::dem
