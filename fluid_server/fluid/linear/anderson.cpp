#include "fluid/linear/anderson.hpp"

#include <Eigen/QR>

namespace fpi::fluid {

Vector Anderson::step(const Vector& correction, const Vector& weight) {
  if (last_step_.size() > 0) remember(last_step_, correction - last_correction_, weight);
  last_correction_ = correction;
  Vector step = correction;
  if (!steps_.empty()) {
    Eigen::MatrixXd changes(correction.size(), static_cast<Eigen::Index>(changes_.size()));
    for (std::size_t j = 0; j < changes_.size(); ++j)
      changes.col(static_cast<Eigen::Index>(j)) = weight.cwiseProduct(changes_[j]);
    const Vector share = changes.colPivHouseholderQr().solve(weight.cwiseProduct(correction));
    for (std::size_t j = 0; j < steps_.size(); ++j)
      step -= share[static_cast<Eigen::Index>(j)] * (steps_[j] + changes_[j]);
  }
  last_step_ = step;
  return step;
}

/// A correction that did not change tells nothing, and a column of zeros is no basis.
void Anderson::remember(const Vector& step, const Vector& change, const Vector& weight) {
  if (weight.cwiseProduct(change).norm() == 0) return;
  if (steps_.size() == depth) {
    steps_.erase(steps_.begin());
    changes_.erase(changes_.begin());
  }
  steps_.push_back(step);
  changes_.push_back(change);
}

void Anderson::clear() {
  steps_.clear();
  changes_.clear();
  last_step_.resize(0);
}

}  // namespace fpi::fluid
