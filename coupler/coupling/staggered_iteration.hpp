/// The implicit staggered iteration of one step: find x for which fluid and DEM move the bodies alike. What x
/// stands for is the map's affair (velocities that the fluid is given, or what the DEM adds to its own
/// balance), so that this runs in tests against maps with a known fixed point.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "coupling/acceleration.hpp"
#include "coupling/convergence.hpp"
#include "coupling/stall.hpp"

namespace fpi::coupling {

/// What the participants made of one iterate.
struct Exchange {
  bool converged = false;      ///< both solved their part
  std::string reason;          ///< why not
  Eigen::VectorXd residual;    ///< r: x + r would be next in the plain iteration
  bool is_newton = false;      ///< which would be Newton's: nothing that was learnt could make it better
  Eigen::VectorXd velocities;  ///< of the bodies
  Eigen::VectorXd forces;      ///< of the fluid on them
  double fluid_speed = 0;      ///< root mean square of its velocity [m/s]; 0 where it is not said
};
using CoupledMap = std::function<Exchange(const Eigen::VectorXd& x, std::uint32_t sub_iteration)>;

/// What is done where an iteration stalls, one after the other.
enum class Remedy { drop_history, aitken, shorter_step };
struct StallEvent {
  Stall stall;
  Remedy remedy;
  Eigen::Index unknown;  ///< with the largest residual
};

struct StepResult {
  bool converged = false;
  std::string reason;                ///< why not
  std::uint32_t sub_iterations = 0;  ///< sub-iterations, with the one that verified convergence
  Residual velocity, force;          ///< of the last sub-iteration
  Eigen::Index worst = 0;            ///< unknown with the largest residual there
  ColumnCount columns;               ///< of the last acceleration
  std::vector<StallEvent> stalls;
};

class StaggeredIteration {
 public:
  /// The residual of the sub-iteration after the next is at least this part of the next one's, whatever is
  /// proven of the map: more than that a step is not taken without being verified.
  static constexpr double least_contraction = 1e-2;
  static constexpr double safe_contraction = 0.2;  ///< above it nothing is taken unverified

  StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs);

  /// Iterates a step of size Δt [s] from `guess`, in units of velocity. `inertia` > 0 measures the unknowns,
  /// so that a norm is a kinetic energy and one factor suits them all. A guess that comes true takes a single
  /// sub-iteration. The scheme "explicit" takes the first sub-iteration as it is, "semi_implicit" corrects
  /// the motion once and takes the second. With "auto" a sub-iteration is taken where the residual of the
  /// next is proven to be within the tolerances: `contraction`, where it is small, bounds the one over the
  /// other.
  StepResult solve(const CoupledMap& map, const Eigen::VectorXd& guess, const Eigen::VectorXd& inertia,
                   double time_step, double contraction = 1);

  /// The step counts, or does not.
  void accept() { acceleration_->accept(); }
  void reject() { acceleration_->reject(); }
  /// What was learnt about these unknowns no longer holds.
  void forget(std::span<const Eigen::Index> unknowns) { acceleration_->forget(unknowns); }

  std::vector<double> state() const { return acceleration_->state(); }
  void set_state(std::span<const double> state) { acceleration_->set_state(state); }

 private:
  bool is_good_enough(const ConvergenceMeasure& measure, double contraction, const StepResult& result) const;

  scene::Coupling parameters_;
  Eigen::VectorXd lever_;
  std::unique_ptr<Acceleration> acceleration_;
};

}  // namespace fpi::coupling
