#include "coupling/balance_forecast.hpp"

#include <Eigen/LU>
#include <utility>

namespace fpi::coupling {

BalanceForecast::BalanceForecast(Eigen::VectorXd mass, Eigen::VectorXd displaced)
    : mass_(std::move(mass)), displaced_(std::move(displaced)) {
  forget();
}

void BalanceForecast::forget() {
  step_ = 0;
  resistance_.resize(0, 0);
  now_ = rise_ = drive_ = drive_rise_ = Eigen::VectorXd::Zero(mass_.size());
}

/// The part of A that is momentum, of every unknown [kg/s, kg m²/s]: M/Δt + m_f (1 + 2r)/(1 + r)/Δt, r the
/// ratio of this step and the last.
Eigen::VectorXd BalanceForecast::momentum_in(double time_step) const {
  const double r = step_ > 0 ? time_step / step_ : 0;
  return (mass_ + (1 + 2 * r) / (1 + r) * displaced_) / time_step;
}

/// h less momentum_in · V_n: with BDF2 the fluid's momentum goes on changing as it did.
Eigen::VectorXd BalanceForecast::momentum_before(double time_step) const {
  const double r = step_ > 0 ? time_step / step_ : 0;
  return r * r / (1 + r) / time_step * displaced_.cwiseProduct(rise_);
}

void BalanceForecast::accept(double time_step, const Eigen::VectorXd& before,
                             const Eigen::VectorXd& velocities, const Eigen::VectorXd& forces,
                             Eigen::MatrixXd resistance) {
  const Eigen::VectorXd history = momentum_in(time_step).cwiseProduct(before) + momentum_before(time_step);
  const Eigen::VectorXd drive = resistance * velocities - history - forces;
  if (knows()) drive_rise_ = drive - drive_;
  drive_ = drive;
  rise_ = velocities - before;
  now_ = velocities;
  step_ = time_step;
  resistance_ = std::move(resistance);
}

void BalanceForecast::take_out(std::span<const Eigen::Index> unknowns) {
  if (!knows()) return;
  for (const Eigen::Index i : unknowns) {
    resistance_.row(i).setZero();
    resistance_.col(i).setZero();
    now_[i] = rise_[i] = 0;
  }
}

Eigen::MatrixXd BalanceForecast::resistance(double time_step) const {
  const Eigen::VectorXd change = (mass_ + 1.5 * displaced_) * (1 / time_step - 1 / step_);
  Eigen::MatrixXd resistance = resistance_;
  for (Eigen::Index i = 0; i < change.size(); ++i)
    if (resistance(i, i) != 0) resistance(i, i) += change[i];
  return resistance;
}

Eigen::VectorXd BalanceForecast::velocities(double time_step, const Eigen::VectorXd& forces) const {
  Eigen::MatrixXd matrix = resistance(time_step);
  Eigen::VectorXd given = momentum_in(time_step).cwiseProduct(now_) + momentum_before(time_step) + drive_ +
                          trend * time_step / step_ * drive_rise_ + forces;
  for (Eigen::Index i = 0; i < given.size(); ++i) {
    if (matrix(i, i) != 0) continue;
    matrix(i, i) = 1;
    given[i] = now_[i];
  }
  return matrix.partialPivLu().solve(given);
}

/// Δt and, where a resistance is known, all vectors and its columns.
std::vector<double> BalanceForecast::state() const {
  std::vector<double> state{step_};
  if (!knows()) return state;
  for (const Eigen::VectorXd* part : {&now_, &rise_, &drive_, &drive_rise_})
    state.insert(state.end(), part->begin(), part->end());
  const auto columns = resistance_.reshaped();
  state.insert(state.end(), columns.begin(), columns.end());
  return state;
}

void BalanceForecast::set_state(std::span<const double> state) {
  forget();
  step_ = state[0];
  if (state.size() == 1) return;
  const auto n = static_cast<std::size_t>(mass_.size());
  std::span<const double> rest = state.subspan(1);
  for (Eigen::VectorXd* part : {&now_, &rise_, &drive_, &drive_rise_}) {
    *part = Eigen::Map<const Eigen::VectorXd>(rest.data(), mass_.size());
    rest = rest.subspan(n);
  }
  resistance_ = Eigen::Map<const Eigen::MatrixXd>(rest.data(), mass_.size(), mass_.size());
}

}  // namespace fpi::coupling
