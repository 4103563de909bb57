/// The coupled problem from one accepted state to the next: places the bodies, lets fluid and DEM answer each
/// other until they agree, and accepts or restores. It knows neither files nor the time loop.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupling/interface_mesh.hpp"
#include "coupling/predictor.hpp"
#include "coupling/prescribed_motion.hpp"
#include "coupling/response.hpp"
#include "coupling/rigid_dofs.hpp"
#include "coupling/staggered_iteration.hpp"
#include "coupling/time_window.hpp"
#include "proto/participant.hpp"
#include "scene/scene.hpp"

namespace fpi {

/// Who takes part; a null pointer where the scene does not need the role. They outlive what uses them.
struct Participants {
  proto::FluidParticipant* fluid = nullptr;
  proto::DemParticipant* dem = nullptr;
  bool fluid_moves_bodies = false;       ///< by balances sent to it (capability "balance")
  bool dem_takes_added_inertia = false;  ///< capability "added_inertia"
};

/// Arrays of numbers by name, for a checkpoint.
using NumbersByName = std::map<std::string, std::vector<double>>;

/// The contents of all files that the scene names.
using Files = std::vector<proto::File>;
/// A participant's own state by role, for a checkpoint.
using StatesByRole = std::map<std::string, proto::Bytes>;

/// The state at the end of a step. Entry i belongs to body i; a scene without a fluid has no tractions and
/// arcs.
struct CoupledState {
  std::vector<coupling::RigidMotion> motions;
  std::vector<coupling::RigidMotion> walls;  ///< of those that move, about their centres
  std::vector<coupling::RigidLoad> loads;
  std::vector<coupling::Arcs> arcs;
  std::vector<proto::Traction> tractions;
};

struct Attempt : coupling::StepResult {
  std::uint32_t newton_iterations = 0;  ///< of all sub-iterations
  double largest_overlap = 0;           ///< [m] of grains
  coupling::TimeError time_error;       ///< of the fluid
};

class Simulation {
 public:
  Simulation(const scene::Scene& scene, Participants participants, std::uint64_t run);

  /// Sends every participant its part of the scene, and its state where a run is resumed.
  void configure(const Files& files, const StatesByRole& states);

  /// Tries the step from `start` to `end` [s] of size `time_step` [s] (0: the steady state), always from the
  /// last accepted state. Either `accept` or `restore` must follow.
  Attempt attempt(double start, double end, double time_step);
  void accept();
  void restore();

  std::uint64_t steps() const { return steps_; }  ///< accepted so far
  const CoupledState& state() const { return accepted_; }
  /// What the fluid reported with the last accepted step: probes and boundary forces. Nothing where it did
  /// not, as for a probe that a body covers for a while.
  std::optional<double> figure(const std::string& name) const;

  /// All that the following steps depend on, participants apart.
  NumbersByName numbers() const;
  void set_numbers(const NumbersByName& numbers);

  /// Called after every exchange with the number of exchanges in the step.
  std::function<void(std::uint32_t)> after_exchange;

 private:
  void place_bodies(double start, double end, double time_step);
  void choose_response();
  Eigen::VectorXd first_iterate() const;
  coupling::Exchange exchange(const Eigen::VectorXd& x, std::uint32_t sub_iteration);
  void add_balances(std::vector<proto::Interface>& interfaces) const;
  std::vector<proto::Load> loads_on_free_bodies() const;
  std::string advance_fluid(const proto::Stamp& stamp);
  std::string advance_dem(const proto::Stamp& stamp);
  void take_tractions(std::vector<proto::Traction> tractions);
  void take_motions(const std::vector<proto::Motion>& motions);
  void take_arc_lengths(const std::vector<proto::ArcLength>& lengths);
  void warn_where_coarse(std::size_t body);

  struct MovingWall {
    std::uint32_t index;  ///< in the scene
    coupling::PrescribedMotion motion;
  };

  const scene::Scene& scene_;
  Participants participants_;
  std::uint64_t run_;
  coupling::RigidDofs dofs_;
  coupling::Predictor predictor_;
  coupling::StaggeredIteration iteration_;
  std::vector<std::optional<coupling::PrescribedMotion>> prescribed_;  ///< of bodies that are not free
  std::vector<MovingWall> moving_walls_;
  std::vector<double> arc_lengths_;        ///< [m] wanted, one a body
  std::vector<bool> told_of_coarse_mesh_;  ///< one a body
  double resolved_gap_ratio_ = 1;          ///< narrowest gap that the fluid resolves, of the arc length

  std::uint64_t steps_ = 0;
  CoupledState accepted_, attempted_;
  bool fluid_moves_bodies_ = false;  ///< x is what the DEM adds, else the velocities that the fluid gets
  Eigen::VectorXd added_;            ///< inertia that the fluid adds to each unknown in this step
  Eigen::VectorXd inertia_;          ///< of each unknown, with what is added
  Eigen::VectorXd force_of_dem_, attempted_force_of_dem_;  ///< mean over a step on each unknown [N], [N m]
  double end_ = 0, time_step_ = 0;                         ///< [s] of the attempt
  std::vector<coupling::RigidMotion>
      placed_;  ///< geometry that the attempt is frozen at, with its velocities
  Attempt report_;
  std::map<std::string, double> figures_;
};

}  // namespace fpi
