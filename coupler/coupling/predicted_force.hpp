/// The balance of all free bodies with the fluid around them, foreseen for a step from those of the last
/// ones: where bodies act on each other, what the fluid will make of their forces is known to some per cent
/// before it is asked.
///
/// A V = h + γ f + G, in the mean over the step: A the fluid's resistance to all bodies with their own
/// inertia [kg/s, kg m/s, kg m²/s], G what contacts, films and weights exert, γ the weight of the step's end
/// in BDF2, f what the flow exerts besides its inertia at rest, and h = (M + m_f) V_n/Δt + (1 − γ) D the
/// momentum that bodies and the fluid they displace bring along, with D the mean over the last step of f less
/// drag. f and D follow the flow and the places of the bodies, which change little in a step, while V and G
/// jump with every impact.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace fpi::coupling {

class PredictedForce {
 public:
  /// Of each unknown: `mass` M of the body, and m_f of the fluid that it displaces (0 of a spin).
  PredictedForce(const Eigen::VectorXd& mass, const Eigen::VectorXd& displaced);

  /// A step of Δt [s] from velocities V_n to V under G, with the resistance A that it found, or without
  /// entries where it found none. Rows of unknowns that take no part are zero.
  void accept(double time_step, const Eigen::VectorXd& before, const Eigen::VectorXd& velocities,
              const Eigen::VectorXd& forces, Eigen::MatrixXd resistance);
  /// These unknowns take no part any more.
  void take_out(std::span<const Eigen::Index> unknowns);
  bool knows() const { return resistance_.size() > 0; }

  /// A in a step of Δt [s]: only the part of the momentum changes with it.
  Eigen::MatrixXd resistance(double time_step) const;
  /// V at the end of a step of Δt [s] under G; V_n of unknowns that take no part.
  Eigen::VectorXd velocities(double time_step, const Eigen::VectorXd& forces) const;

  std::vector<double> state() const;
  void set_state(std::span<const double> state);

 private:
  /// How much of the change of f in the last step is expected in the next one: with all of it f is of second
  /// order, but what impacts leave in it counts twice (numerics.md).
  static constexpr double trend = 0.5;

  /// Of a step of Δt after the last one: 1 (backward Euler) where there is none.
  double gamma(double time_step) const;
  Eigen::VectorXd momentum(double time_step, const Eigen::VectorXd& velocities) const;

  Eigen::VectorXd mass_;        ///< M + m_f
  double step_ = 0;             ///< Δt of the last step [s]
  double gamma_ = 1;            ///< in it
  Eigen::VectorXd now_, mean_;  ///< V_n, D
  Eigen::MatrixXd resistance_;
  Eigen::VectorXd drive_, drive_rise_;  ///< f, its change in the last step
};

}  // namespace fpi::coupling
