/// The first guess of the velocities at the end of a step. The geometry of the step is placed with it and
/// stays.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace fpi::coupling {

class Predictor {
 public:
  /// `kind`: "constant" (V_n) or "linear" (V_n + Δt/Δt' (V_n − V_{n−1}), with Δt' the step before).
  explicit Predictor(const std::string& kind) : linear_(kind == "linear") {}

  /// The guess for a step of size Δt [s] that starts with `velocities`; constant while there is no history.
  Eigen::VectorXd guess(const Eigen::VectorXd& velocities, double time_step) const;
  /// A step of size Δt that started with `velocities` was accepted.
  void accept(const Eigen::VectorXd& velocities, double time_step);

  std::vector<double> state() const;
  void set_state(std::span<const double> state);

 private:
  bool linear_;
  Eigen::VectorXd before_;  ///< V_{n−1}
  double step_before_ = 0;  ///< Δt' [s]; 0: no history yet
};

}  // namespace fpi::coupling
