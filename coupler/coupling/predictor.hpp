/// The first guess of the velocities at the end of a step, which the geometry of the step is placed with.
/// Every kind of guess is measured against the motion found, body by body, and the best so far is taken.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace fpi::coupling {

/// What is known of the unknowns, three a body, where a step of Δt begins.
struct StepStart {
  Eigen::VectorXd velocities;     ///< V_n
  Eigen::VectorXd force;          ///< F_n, of the fluid and weight, without contacts [N], [N m]
  Eigen::VectorXd inertia;        ///< m
  Eigen::VectorXd added_inertia;  ///< m_a that the fluid adds
  double time_step = 0;           ///< Δt [s]
};

/// "constant": V_n; "linear" and "quadratic": extrapolated through the last two or three velocities, at any
/// step sizes; "physical": (m + m_a)(V − V_n)/Δt = F_n + m_a a_n, the equation of motion with the last force
/// less what the last acceleration a_n was answered with, so that an impact is not extrapolated; "auto": for
/// each body the one whose error, halved in weight with each step, is the least. Where there is no history
/// for an order, the one below stands in; after a rejected step V_n does.
class Predictor {
 public:
  explicit Predictor(const std::string& kind);

  Eigen::VectorXd guess(const StepStart& start);
  /// The step that was guessed last ended with `found`.
  void accept(const Eigen::VectorXd& found);
  void reject() { careful_ = true; }

  std::vector<double> state() const;
  void set_state(std::span<const double> state);

 private:
  enum Kind { physical, linear, quadratic, constant, n_kinds };
  static constexpr int automatic = n_kinds;
  static int kind_of(const std::string& name);
  Eigen::MatrixXd all(const StepStart& start) const;

  int kind_;
  bool careful_ = false;
  Eigen::VectorXd before_, second_;                  ///< V_{n−1}, V_{n−2}; empty without history
  double step_before_ = 0, second_step_before_ = 0;  ///< [s] that ended with V_n, with V_{n−1}
  Eigen::MatrixXd errors_;                           ///< running, of each kind (column) and body, squared
  StepStart start_;                                  ///< of the step under way
  Eigen::MatrixXd guesses_;                          ///< of it, one column a kind
};

}  // namespace fpi::coupling
