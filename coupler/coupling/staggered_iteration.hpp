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

namespace fpi::coupling {

/// What the participants made of one iterate.
struct Exchange {
  bool converged = false;      ///< both solved their part
  std::string reason;          ///< why not
  Eigen::VectorXd residual;    ///< r: x + r would be next in the plain iteration
  Eigen::VectorXd velocities;  ///< of the bodies
  Eigen::VectorXd forces;      ///< of the fluid on them
};
using CoupledMap = std::function<Exchange(const Eigen::VectorXd& x, std::uint32_t sub_iteration)>;

struct StepResult {
  bool converged = false;
  std::string reason;                ///< why not
  std::uint32_t sub_iterations = 0;  ///< exchanges, with the one that verified convergence
  Residual velocity, force;          ///< of the last exchange
};

class StaggeredIteration {
 public:
  StaggeredIteration(const scene::Coupling& parameters, const RigidDofs& dofs);

  /// Iterates a step of size Δt [s] from `guess`, in units of velocity. `inertia` > 0 measures the unknowns,
  /// so that a norm is a kinetic energy and one factor suits them all. A guess that comes true takes a single
  /// exchange.
  StepResult solve(const CoupledMap& map, const Eigen::VectorXd& guess, const Eigen::VectorXd& inertia,
                   double time_step);

  /// The step counts, or does not.
  void accept() { acceleration_->accept(); }
  void reject() { acceleration_->reject(); }
  /// What was learnt about these unknowns no longer holds.
  void forget(std::span<const Eigen::Index> unknowns) { acceleration_->forget(unknowns); }

  std::vector<double> state() const { return acceleration_->state(); }
  void set_state(std::span<const double> state) { acceleration_->set_state(state); }

 private:
  scene::Coupling parameters_;
  Eigen::VectorXd lever_;
  std::unique_ptr<Acceleration> acceleration_;
};

}  // namespace fpi::coupling
