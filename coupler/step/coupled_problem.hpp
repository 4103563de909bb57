/// The coupled problem from one accepted state to the next: places the bodies, lets fluid and DEM answer each
/// other until they agree, and accepts or restores. It knows neither messages, files nor the time loop.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coupling/predicted_force.hpp"
#include "coupling/predictor.hpp"
#include "coupling/prescribed_motion.hpp"
#include "coupling/response.hpp"
#include "step/coupled_state.hpp"
#include "step/outlets.hpp"
#include "step/solver_requests.hpp"

namespace fpi {

class CoupledProblem {
 public:
  CoupledProblem(const scene::Scene& scene, Participants participants, std::uint64_t run);
  CoupledProblem(const CoupledProblem&) = delete;  // its solvers refer to its unknowns
  CoupledProblem& operator=(const CoupledProblem&) = delete;

  /// Sends every participant its part of the scene, and its state where a run is resumed.
  Findings configure(const Files& files, const StatesByRole& states) {
    return solvers_.configure(files, states);
  }
  /// What would refuse the first step, and what is doubtful in it, without solving for the flow. Nothing can
  /// be asked after it.
  Findings rehearse(double end, double time_step);

  /// Tries the step from `start` to `end` [s] of size `time_step` [s] (0: the steady state), always from the
  /// last accepted state. Either `accept` or `restore` must follow.
  Attempt attempt(double start, double end, double time_step);
  /// Before the first step, which is to have about `time_step` [s]: bodies that start with a velocity push
  /// the fluid off at once, and a fluid that moves pushes bodies. A step of vanishing length finds the
  /// velocities after this impulse, in which fluid and free bodies keep the sum of their momenta; the steps
  /// then start from what is smooth. Returns the attempt, not converged where it was taken back, or nothing
  /// where no impulse is needed or the fluid does not solve it with the bodies.
  std::optional<Attempt> start_suddenly(double time_step);
  void accept();
  void restore();

  std::uint64_t steps() const { return steps_; }  ///< accepted so far
  const CoupledState& state() const { return accepted_; }
  const SolverRequests& solvers() const { return solvers_; }
  /// What participants found in the accepted states since the last call.
  Findings take_findings() { return solvers_.take_findings(); }
  /// Bodies that left with the last accepted step.
  const std::vector<Departure>& departures() const { return departures_; }
  /// The name of the body that an unknown of the coupling belongs to.
  const std::string& body_of(Eigen::Index unknown) const {
    return scene_.bodies[dofs_.bodies()[static_cast<std::size_t>(unknown / 3)]].name;
  }
  /// What a participant reported with the last accepted step: probes, boundary forces, energies. Nothing
  /// where it did not, as for a probe that a body covers for a while.
  std::optional<double> figure(const std::string& name) const { return solvers_.figure(name); }

  /// All that the following steps depend on, participants apart.
  NumbersByName numbers() const;
  void set_numbers(const NumbersByName& numbers);

  /// Called after every sub-iteration with the number of sub-iterations in the step.
  std::function<void(std::uint32_t)> after_sub_iteration;

 private:
  void float_in_still_fluid();
  bool starts_suddenly() const;
  void settle();
  void begin_trial(double start, double end, double time_step);
  Eigen::VectorXd place_first(double start, Eigen::VectorXd& force_of_dem);
  void place_bodies(double start, const Eigen::VectorXd& predicted);
  bool stays_cut(std::size_t body) const;
  coupling::Arcs surface(std::size_t body, const coupling::RigidMotion& placed) const;
  void foresee_contacts(double start, Eigen::VectorXd& velocities, Eigen::VectorXd& force_of_dem);
  bool bodies_act(const Eigen::VectorXd& force_of_dem) const;
  Eigen::VectorXd of_bodies_there(Eigen::VectorXd unknowns, const CoupledState& state) const;
  std::vector<Eigen::Index> unknowns_left(const CoupledState& state) const;
  Eigen::VectorXd missing_force(const Eigen::VectorXd& residual) const;
  void iterate(const Eigen::VectorXd& first);
  bool is_badly_placed() const;
  void measure_ways();
  void take_iterate(const Eigen::VectorXd& x);
  coupling::StepStart step_start() const;
  double contraction() const;
  double element_size(std::size_t body) const;
  Eigen::VectorXd iterate_of(const Eigen::VectorXd& force_of_dem) const;
  void remember_balance();
  void forget_changed_bodies();
  coupling::Exchange exchange(const Eigen::VectorXd& x, std::uint32_t sub_iteration);

  const scene::Scene& scene_;
  std::uint64_t run_;
  coupling::RigidDofs dofs_;
  bool fluid_can_move_bodies_;
  bool fluid_moves_bodies_;  ///< x is what the DEM adds, else the velocities that the fluid gets
  SolverRequests solvers_;
  coupling::Predictor predictor_;
  coupling::PredictedForce forecast_;
  coupling::StaggeredIteration iteration_;
  std::vector<std::optional<coupling::PrescribedMotion>> prescribed_;  ///< of bodies that are not free
  std::vector<coupling::PrescribedMotion> moving_walls_;

  std::uint64_t steps_ = 0;
  CoupledState accepted_;
  std::vector<Departure> departures_;
  Eigen::VectorXd force_of_dem_;  ///< mean over the accepted step on each unknown [N], [N m]
  Trial trial_;
  std::uint32_t exchanges_ = 0;  ///< in it
  Eigen::VectorXd inertia_;      ///< of each unknown in the trial, with what the fluid adds
};

}  // namespace fpi
