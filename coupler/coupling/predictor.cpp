#include "coupling/predictor.hpp"

namespace fpi::coupling {

Eigen::VectorXd Predictor::guess(const Eigen::VectorXd& velocities, double time_step) const {
  if (!linear_ || step_before_ <= 0) return velocities;
  return velocities + time_step / step_before_ * (velocities - before_);
}

void Predictor::accept(const Eigen::VectorXd& velocities, double time_step) {
  before_ = velocities;
  step_before_ = time_step;
}

std::vector<double> Predictor::state() const {
  std::vector<double> state{step_before_};
  state.insert(state.end(), before_.begin(), before_.end());
  return state;
}

void Predictor::set_state(std::span<const double> state) {
  step_before_ = state[0];
  before_ = Eigen::Map<const Eigen::VectorXd>(state.data() + 1, static_cast<Eigen::Index>(state.size()) - 1);
}

}  // namespace fpi::coupling
