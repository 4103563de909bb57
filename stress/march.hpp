/// A flow around bodies whose places are functions of time, run straight against the fluid library: what its
/// forces were from step to step, and how quiet they are.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "fluid/navier_stokes.hpp"

namespace fpi::fluid::testing {

/// Interfaces of all bodies at time t [s]; asks the solver for arc lengths.
using Bodies = std::function<std::vector<Interface>(double t, const NavierStokes& solver)>;

/// What the fluid does to one body [N/m, N].
struct Load {
  Vec2 force = Vec2::Zero();
  double torque = 0;
};

struct History {
  std::vector<std::vector<Load>> loads;  ///< of each step, of each body
  double corrections = 0;                ///< a step, on average
  std::string failure;                   ///< why the run ended early; "" where it did not
  bool refused = false;                  ///< it ended early with an Error, the fluid's own sentence
};

/// Beyond these a run counts as blown up.
struct Bounds {
  double velocity = std::numeric_limits<double>::infinity();  ///< of the fluid anywhere [m/s]
  double force = std::numeric_limits<double>::infinity();     ///< on a body [N/m]
};

/// Steps of equal length from t = 0 on; ends early where one throws, does not converge or is out of bounds.
History march(NavierStokes& solver, const Bodies& bodies, double time_step, int steps,
              const Bounds& bounds = {});

/// How far each force is from the cubic through its two neighbours on both sides: what no smooth force has.
struct Noise {
  double largest_force = 0;   ///< of the steps from `first` on [N/m]
  double rms = 0, worst = 0;  ///< of the distances, over the largest force
};
Noise noise(const std::vector<Vec2>& force, std::size_t first);

std::vector<Vec2> forces(const History& history, std::size_t body);

}  // namespace fpi::fluid::testing
