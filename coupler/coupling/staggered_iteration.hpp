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
  Residual velocity, force;          ///< of the last exchange
};

class StaggeredIteration {
 public:
  StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs);

  /// Iterates a step of size Δt [s] from `guess`. A guess that comes true takes a single exchange.
  StepResult solve(const CoupledMap& map, const Eigen::VectorXd& guess, double time_step);

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
