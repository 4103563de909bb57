/// The messages to the solvers of a run: what fluid and DEM are told of an attempt, and what of their answers
/// enters it. The story of a step is told in problem.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/findings.hpp"
#include "proto/participant.hpp"
#include "scene/scene.hpp"
#include "step/coupled_state.hpp"
#include "step/outlets.hpp"

namespace fpi {

/// Who takes part; a null pointer where the scene does not need the role. They outlive what uses them.
struct Participants {
  proto::FluidParticipant* fluid = nullptr;
  proto::DemParticipant* dem = nullptr;
  bool fluid_moves_bodies = false;       ///< by balances sent to it (capability "balance")
  bool dem_takes_added_inertia = false;  ///< capability "added_inertia"
  bool dem_takes_resistance = false;     ///< capability "resistance"
  bool save_their_state = true;          ///< capability "checkpoint" of all
};

/// The contents of all files that the scene names.
using Files = std::vector<proto::File>;
/// A participant's own state by role, for a checkpoint.
using StatesByRole = std::map<std::string, proto::Bytes>;

/// How many elements the diameter of a body spans where the fluid wants arcs of that length [m].
double elements_per_diameter(const scene::Scene& scene, std::size_t body, double arc_length);

class SolverRequests {
 public:
  /// `fluid_moves_bodies`: it is sent the balances of the free bodies and finds their velocities.
  SolverRequests(const scene::Scene& scene, const coupling::RigidDofs& dofs, Participants participants,
                 bool fluid_moves_bodies);

  /// Sends every participant its part of the scene, and its state where a run is resumed. With an error among
  /// the findings nothing else may be asked of them.
  Findings configure(const Files& files, const StatesByRole& states);
  /// What they said of the scene then, by role.
  const std::map<std::string, proto::Figures>& configured_figures() const { return configured_figures_; }
  /// What would have the fluid refuse the trial, which started from `before`, and what is doubtful in it.
  Findings rehearse(const proto::Stamp& stamp, const CoupledState& before, const Trial& trial);

  bool has_fluid() const { return participants_.fluid != nullptr; }
  bool dem_takes_added_inertia() const { return participants_.dem_takes_added_inertia; }
  bool dem_takes_resistance() const { return participants_.dem_takes_resistance; }

  /// Both let their solver answer to the trial, which started from `before`; a role that does not take part
  /// has nothing to say. Returns "" or why the solver did not converge.
  std::string advance_fluid(const proto::Stamp& stamp, const CoupledState& before, Trial& trial);
  std::string advance_dem(const proto::Stamp& stamp, Trial& trial);
  /// `leaving`: bodies that take no part any more.
  void accept(const CoupledState& state, const std::vector<Departure>& leaving);
  /// Of the accepted states since the last call.
  Findings take_findings() { return std::exchange(findings_, {}); }
  void restore();

  /// [m] that the fluid wants for the interface mesh, one a body.
  const std::vector<double>& arc_lengths() const { return arc_lengths_; }
  void set_arc_lengths(const std::vector<double>& lengths) { arc_lengths_ = lengths; }
  /// What a participant reported with the last accepted step.
  std::optional<double> figure(const std::string& name) const;

 private:
  proto::FluidAdvance message_to_fluid(const CoupledState& before, const Trial& trial) const;
  void add_balances(const CoupledState& before, const Trial& trial,
                    std::vector<proto::Interface>& interfaces) const;
  std::vector<Eigen::Index> unknowns_there(const CoupledState& state) const;
  void take_resistance(std::span<const double> by_rows, Trial& trial) const;
  void take_tractions(std::vector<proto::Traction> tractions, Trial& trial) const;
  proto::DemAdvance message_to_dem(const Trial& trial) const;
  std::vector<proto::Load> loads_on_free_bodies(const Trial& trial) const;
  void take_motions(const std::vector<proto::Motion>& motions, CoupledState& state) const;
  std::vector<proto::ArcLength> wanted_lengths(const CoupledState& state) const;
  void take_arc_lengths(const std::vector<proto::ArcLength>& lengths);
  void warn_where_coarse(std::size_t body);
  void find_unresolved(Findings& findings) const;

  const scene::Scene& scene_;
  const coupling::RigidDofs& dofs_;
  Participants participants_;
  bool fluid_moves_bodies_;
  std::vector<std::uint32_t> moving_walls_;  ///< their numbers in the scene
  std::vector<double> arc_lengths_;
  std::vector<bool> told_of_coarse_mesh_;  ///< one a body
  double resolved_gap_ratio_ = 1;          ///< narrowest gap that the fluid resolves, of the arc length
  std::map<std::string, double> figures_;
  std::map<std::string, proto::Figures> configured_figures_;
  Findings findings_;
};

}  // namespace fpi
