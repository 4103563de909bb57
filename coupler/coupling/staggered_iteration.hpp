/// The implicit staggered iteration of one step: find x with H(x) = x, where H sends the velocities x to the
/// fluid, the forces that come back to the DEM, and returns its velocities. H is any function, so that this
/// runs in tests against maps with a known fixed point.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "coupling/acceleration.hpp"
#include "coupling/convergence.hpp"

namespace fpi::coupling {

/// What the participants made of one iterate.
struct Exchange {
  bool converged = false;      ///< both solved their part
  std::string reason;          ///< why not
  Eigen::VectorXd velocities;  ///< H(x)
  Eigen::VectorXd forces;      ///< that moved the bodies so
};
using CoupledMap = std::function<Exchange(const Eigen::VectorXd& velocities, std::uint32_t sub_iteration)>;

struct StepResult {
  bool converged = false;
  std::string reason;                ///< why not
  std::uint32_t sub_iterations = 0;  ///< exchanges, with the one that verified convergence
  Change velocity, force;            ///< of the last exchange
};

class StaggeredIteration {
 public:
  StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs);

  /// Iterates from `guess`. The forces of the first exchange are measured against `forces_before`, those at
  /// the start of the step: a step whose prediction comes true in motion and force takes a single exchange.
  StepResult solve(const CoupledMap& map, const Eigen::VectorXd& guess, const Eigen::VectorXd& forces_before);

  /// The step counts, or does not.
  void accept() { acceleration_->accept(); }
  void reject() { acceleration_->reject(); }

  std::vector<double> state() const { return acceleration_->state(); }
  void set_state(std::span<const double> state) { acceleration_->set_state(state); }

 private:
  std::uint32_t max_iterations_;
  Eigen::VectorXd scale_;
  ConvergenceMeasure measure_;
  std::unique_ptr<Acceleration> acceleration_;
};

}  // namespace fpi::coupling
