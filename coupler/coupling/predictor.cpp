#include "coupling/predictor.hpp"

#include <algorithm>
#include <array>

namespace fpi::coupling {

int Predictor::kind_of(const std::string& name) {
  constexpr std::array<const char*, n_kinds> names{"physical", "linear", "quadratic", "constant"};
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

Predictor::Predictor(const std::string& kind) : kind_(kind_of(kind)) {}

Eigen::MatrixXd Predictor::all(const StepStart& start) const {
  const Eigen::VectorXd& now = start.velocities;
  const double dt = start.time_step, b = step_before_, c = second_step_before_;
  Eigen::MatrixXd guesses = now.replicate(1, n_kinds);
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(now.size());
  if (before_.size() > 0) acceleration = (now - before_) / b;
  guesses.col(linear) += dt * acceleration;
  guesses.col(quadratic) += dt * acceleration;
  if (second_.size() > 0)  // Newton's form through t_n, t_n − b, t_n − b − c
    guesses.col(quadratic) += dt * (dt + b) / (b + c) * (acceleration - (before_ - second_) / c);
  const Eigen::VectorXd force = start.force + start.added_inertia.cwiseProduct(acceleration);
  guesses.col(physical) += dt * force.cwiseQuotient(start.inertia + start.added_inertia);
  return guesses;
}

Eigen::VectorXd Predictor::guess(const StepStart& start) {
  start_ = start;
  guesses_ = all(start);
  if (careful_) return start.velocities;
  if (kind_ != automatic) return guesses_.col(kind_);
  Eigen::VectorXd best = start.velocities;
  if (errors_.size() == 0) errors_ = Eigen::MatrixXd::Zero(best.size() / 3, n_kinds);
  for (Eigen::Index body = 0; body < errors_.rows(); ++body) {
    Eigen::Index kind = 0;
    errors_.row(body).minCoeff(&kind);
    best.segment<3>(3 * body) = guesses_.col(kind).segment<3>(3 * body);
  }
  return best;
}

void Predictor::accept(const Eigen::VectorXd& found) {
  careful_ = false;
  const Eigen::VectorXd weight = (start_.inertia + start_.added_inertia).cwiseSqrt();
  for (Eigen::Index body = 0; body < errors_.rows(); ++body)
    for (int kind = 0; kind < n_kinds; ++kind) {
      const Eigen::Vector3d miss = (guesses_.col(kind) - found).cwiseProduct(weight).segment<3>(3 * body);
      errors_(body, kind) = 0.5 * (errors_(body, kind) + miss.squaredNorm());
    }
  second_ = std::move(before_);
  before_ = start_.velocities;
  second_step_before_ = step_before_;
  step_before_ = start_.time_step;
}

/// Steps, the fallback, numbers of unknowns with a history of one and of two steps, those, errors.
std::vector<double> Predictor::state() const {
  std::vector<double> state{step_before_, second_step_before_, careful_ ? 1.0 : 0.0,
                            static_cast<double>(before_.size()), static_cast<double>(second_.size())};
  state.insert(state.end(), before_.begin(), before_.end());
  state.insert(state.end(), second_.begin(), second_.end());
  state.insert(state.end(), errors_.data(), errors_.data() + errors_.size());
  return state;
}

void Predictor::set_state(std::span<const double> state) {
  step_before_ = state[0];
  second_step_before_ = state[1];
  careful_ = state[2] != 0;
  const auto first = static_cast<std::size_t>(state[3]), second = static_cast<std::size_t>(state[4]);
  const auto vector = [](std::span<const double> numbers) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
  };
  before_ = vector(state.subspan(5, first));
  second_ = vector(state.subspan(5 + first, second));
  const std::span<const double> errors = state.subspan(5 + first + second);
  errors_ = Eigen::Map<const Eigen::MatrixXd>(errors.data(),
                                              static_cast<Eigen::Index>(errors.size()) / n_kinds, n_kinds);
}

}  // namespace fpi::coupling
