/// All that a step starts from, and its form in a checkpoint.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

/// Where the surface of a body is: its centroid, and for a polygon the angle under which its first corner is
/// seen from there.
struct BodyPlace {
  Index body;
  Vec2 centre;   ///< [m]
  double angle;  ///< [rad]
};

/// What the fluid exerted on a body in the mean over a step: its impulse over Δt.
struct MeanLoad {
  Index body = 0;
  Vec2 force = Vec2::Zero();  ///< [N/m]
  double torque = 0;          ///< about the centre [N]
};

inline constexpr int highest_order = 2,
                     n_orders = highest_order + 1;  ///< of predictions, see time_scheme.hpp

struct State {
  double time = 0;      ///< [s]
  Vector u;             ///< x, y of each node [m/s]
  Vector acceleration;  ///< x, y of each node, along its path [m/s²]
  Vector p;             ///< of each vertex [Pa]
  bool has_acceleration = false;
  double previous_step = 0;  ///< Δt of the step that led here [s]; 0: there is none
  double step_before = 0;    ///< Δt of the step before it [s]; 0: there is none
  Vector previous_u;         ///< at its start [m/s]
  bool has_previous_acceleration = false;
  Vector previous_acceleration;   ///< at its start [m/s²]
  Vector mesh_velocity;           ///< mean velocity of each node's path over it [m/s], see motion.hpp
  std::vector<BodyPlace> places;  ///< of the bodies
  std::vector<MeanLoad> loads;    ///< on them, over the step that led here
  /// Area [m²] and ∫u [m³/s], x and y, of the fluid in each cell, here and at the start of the step that led
  /// here; empty where no bodies move, or not known.
  Vector fluid_in_cells, previous_fluid_in_cells;
  int damped_steps = -1;  ///< that a sudden start still takes; −1: not known before the first step
  std::array<double, n_orders> prediction_errors{};  ///< of each order in the last steps [m²/s²]

  static State at_rest(Index n_nodes, Index n_vertices);
  /// Keeps the velocity, and nothing of how it changes nor of the pressure that changed it.
  void forget_past();
};

std::vector<std::uint8_t> to_bytes(const State& state);

/// Throws Error for bytes that are not a state of a mesh with so many nodes and vertices.
State from_bytes(std::span<const std::uint8_t> bytes, Index n_nodes, Index n_vertices);

}  // namespace fpi::fluid
