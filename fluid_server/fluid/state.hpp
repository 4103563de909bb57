/// All that a step starts from, and its form in a checkpoint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fluid/types.hpp"

namespace fpi::fluid {

struct State {
  double time = 0;      ///< [s]
  Vector u;             ///< x, y of each node [m/s]
  Vector acceleration;  ///< x, y of each node [m/s²]
  Vector p;             ///< of each vertex [Pa]
  bool has_acceleration = false;
  double previous_step = 0;      ///< Δt of the step that led here [s]; 0: there is none, or none to build on
  Vector previous_acceleration;  ///< at its start [m/s²]
  int damped_steps = -1;         ///< that a sudden start still takes; −1: not known before the first step
};

std::vector<std::uint8_t> to_bytes(const State& state);

/// Throws Error for bytes that are not a state of a mesh with so many nodes and vertices.
State from_bytes(std::span<const std::uint8_t> bytes, Index n_nodes, Index n_vertices);

}  // namespace fpi::fluid
