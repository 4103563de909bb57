/// The state of the coupled problem between two steps, and one attempt at the step after it: what the solvers
/// are asked and what they answered.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "coupling/interface_mesh.hpp"
#include "coupling/rigid_dofs.hpp"
#include "coupling/staggered_iteration.hpp"
#include "coupling/time_window.hpp"
#include "proto/messages.hpp"
#include "step/onset.hpp"

namespace fpi {

/// Arrays of numbers by name, for a checkpoint.
using NumbersByName = std::map<std::string, std::vector<double>>;

/// What left through an outlet since the start of the run.
struct Departed {
  double count = 0, mass = 0;                          ///< bodies, [kg]
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< that they took along [kg m/s]
};

/// The state at the end of a step. Entry i belongs to body i; a scene without a fluid has no tractions and
/// arcs.
struct CoupledState {
  std::vector<coupling::RigidMotion> motions;
  std::vector<coupling::RigidMotion> walls;  ///< of those that move, about their centres
  std::vector<coupling::RigidLoad> loads;    ///< of the fluid
  std::vector<Eigen::Vector3d> cut_at;       ///< where the fluid had the centre of each body [m]
  std::vector<coupling::Arcs> arcs;
  std::vector<proto::Traction> tractions;
  std::vector<std::uint32_t> contacts;  ///< of each body; empty where the DEM does not say
  std::vector<bool> left;               ///< of each body: it is no longer there (outlets.hpp)
  std::vector<Departed> departed;       ///< through each outlet
  std::optional<Onset> onset;           ///< of motion

  bool is_there(std::size_t body) const { return !left[body]; }
};

/// What the following steps depend on; arcs and tractions are found anew in each.
void put_numbers(const CoupledState& state, NumbersByName& numbers);
/// Reads them into a state of as many bodies and walls.
void take_numbers(const NumbersByName& numbers, CoupledState& state);

struct Attempt : coupling::StepResult {
  std::uint32_t newton_iterations = 0;  ///< of all sub-iterations
  double largest_overlap = 0;           ///< [m] of grains
  coupling::TimeError time_error;       ///< of the fluid
  double displacement = 0;              ///< largest way of a body, in element sizes beside it
  double miss = 0;                      ///< largest distance from where a free body was predicted, likewise
  std::uint32_t recuts = 0;             ///< times that the geometry was cut anew
};

/// An attempt under way.
struct Trial {
  double end = 0, time_step = 0;  ///< [s]
  /// Geometry that the attempt is frozen at, with the velocities that the fluid has there.
  std::vector<coupling::RigidMotion> placed;
  CoupledState state;            ///< at its end, as far as the solvers answered
  Eigen::VectorXd added;         ///< inertia that the fluid adds to each unknown
  Eigen::VectorXd force_of_dem;  ///< mean over the step on each unknown [N], [N m]
  /// How these go with the unknowns at the end of the step, as the fluid says [kg/s, kg m/s, kg m²/s];
  /// without entries where it does not.
  Eigen::MatrixXd resistance;
  double fluid_speed = 0;         ///< root mean square of the fluid's velocity [m/s]; 0 where it is not said
  bool wants_resistance = false;  ///< from the fluid
  Attempt report;
};

}  // namespace fpi
