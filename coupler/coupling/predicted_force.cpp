#include "coupling/predicted_force.hpp"

#include <Eigen/LU>
#include <utility>

namespace fpi::coupling {

PredictedForce::PredictedForce(const Eigen::VectorXd& mass, const Eigen::VectorXd& displaced)
    : mass_(mass + displaced) {
  now_ = mean_ = drive_ = drive_rise_ = Eigen::VectorXd::Zero(mass_.size());
}

double PredictedForce::gamma(double time_step) const {
  const double r = step_ > 0 ? time_step / step_ : 0;
  return (1 + r) / (1 + 2 * r);
}

/// h, from velocities V_n.
Eigen::VectorXd PredictedForce::momentum(double time_step, const Eigen::VectorXd& velocities) const {
  return mass_.cwiseProduct(velocities) / time_step + (1 - gamma(time_step)) * mean_;
}

void PredictedForce::accept(double time_step, const Eigen::VectorXd& before,
                            const Eigen::VectorXd& velocities, const Eigen::VectorXd& forces,
                            Eigen::MatrixXd resistance) {
  const double g = gamma(time_step);
  const bool knew = knows();
  resistance_ = std::move(resistance);
  if (knows()) {
    const Eigen::VectorXd drive = (resistance_ * velocities - momentum(time_step, before) - forces) / g;
    drive_rise_ = knew ? Eigen::VectorXd(drive - drive_) : Eigen::VectorXd::Zero(drive.size());
    drive_ = drive;
  }
  mean_ = mass_.cwiseProduct(velocities - before) / time_step - forces;
  now_ = velocities;
  step_ = time_step;
  gamma_ = g;
}

void PredictedForce::take_out(std::span<const Eigen::Index> unknowns) {
  for (const Eigen::Index i : unknowns) {
    now_[i] = mean_[i] = 0;
    if (!knows()) continue;
    resistance_.row(i).setZero();
    resistance_.col(i).setZero();
  }
}

Eigen::MatrixXd PredictedForce::resistance(double time_step) const {
  const double ratio = gamma(time_step) / gamma_;
  Eigen::MatrixXd resistance = ratio * resistance_;
  for (Eigen::Index i = 0; i < mass_.size(); ++i)
    if (resistance(i, i) != 0) resistance(i, i) += mass_[i] * (1 / time_step - ratio / step_);
  return resistance;
}

Eigen::VectorXd PredictedForce::velocities(double time_step, const Eigen::VectorXd& forces) const {
  Eigen::MatrixXd matrix = resistance(time_step);
  const Eigen::VectorXd drive = drive_ + trend * time_step / step_ * drive_rise_;
  Eigen::VectorXd given = momentum(time_step, now_) + gamma(time_step) * drive + forces;
  for (Eigen::Index i = 0; i < given.size(); ++i) {
    if (matrix(i, i) != 0) continue;
    matrix(i, i) = 1;
    given[i] = now_[i];
  }
  return matrix.partialPivLu().solve(given);
}

/// Δt, γ, D and, where a resistance is known, the other vectors and its columns.
std::vector<double> PredictedForce::state() const {
  std::vector<double> state{step_, gamma_};
  state.insert(state.end(), mean_.begin(), mean_.end());
  if (!knows()) return state;
  for (const Eigen::VectorXd* part : {&now_, &drive_, &drive_rise_})
    state.insert(state.end(), part->begin(), part->end());
  const auto columns = resistance_.reshaped();
  state.insert(state.end(), columns.begin(), columns.end());
  return state;
}

void PredictedForce::set_state(std::span<const double> state) {
  const auto n = static_cast<std::size_t>(mass_.size());
  const auto take = [&state, n] {
    const Eigen::VectorXd part =
        Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(n));
    state = state.subspan(n);
    return part;
  };
  step_ = state[0];
  gamma_ = state[1];
  state = state.subspan(2);
  mean_ = take();
  resistance_.resize(0, 0);
  if (state.empty()) return;
  for (Eigen::VectorXd* part : {&now_, &drive_, &drive_rise_}) *part = take();
  resistance_ = Eigen::Map<const Eigen::MatrixXd>(state.data(), mass_.size(), mass_.size());
}

}  // namespace fpi::coupling
