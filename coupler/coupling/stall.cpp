#include "coupling/stall.hpp"

namespace fpi::coupling {

/// As one of the last few, but not as the one just before, which would be a stagnation.
bool StallWatch::comes_back(const Eigen::VectorXd& residual) const {
  const double near = same * residual.norm();
  for (std::size_t p = 1; p < last_.size(); ++p)
    if ((residual - last_[p]).norm() <= near && (residual - last_[0]).norm() > 10 * near) return true;
  return false;
}

Stall StallWatch::add(const Eigen::VectorXd& residual) {
  const double norm = residual.norm();
  returns_ = comes_back(residual) ? returns_ + 1 : 0;
  last_.push_front(residual);
  if (last_.size() > longest_cycle) last_.pop_back();
  if (best_ == 0 || norm < progress * best_) {
    best_ = norm;
    since_ = 0;
  } else {
    ++since_;
  }
  if (returns_ >= 2) return Stall::cycle;
  return since_ >= patience ? Stall::stagnation : Stall::none;
}

}  // namespace fpi::coupling
