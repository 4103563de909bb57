#include "coupling/aitken.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace fpi::coupling {

double aitken_factor(double factor_before, const Eigen::VectorXd& residual_before,
                     const Eigen::VectorXd& residual) {
  const Eigen::VectorXd change = residual - residual_before;
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
  if (change.norm() <= round_off * residual_before.norm()) return factor_before;
  const double factor = -factor_before * residual_before.dot(change) / change.squaredNorm();
  return std::isfinite(factor) ? std::clamp(factor, Aitken::smallest, Aitken::largest) : factor_before;
}

Aitken::Aitken(double first) : first_(first), factor_(first) {
  require(first > 0 && first <= largest, "a first relaxation factor in (0, {}] is required; got {}", largest,
          first);
}

Eigen::VectorXd Aitken::next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) {
  if (residual_before_) factor_ = aitken_factor(factor_, *residual_before_, residual);
  residual_before_ = residual;
  return x + factor_ * residual;
}

}  // namespace fpi::coupling
