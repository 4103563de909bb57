#include "fluid/kept_factor.hpp"

#include <cmath>

namespace fpi::fluid {

void KeptFactor::lend(Iterate& iterate, double inertia, bool is_linear) const {
  iterate.factor = nullptr;
  iterate.cost = cost_;
  if (!factor_) return;
  const bool close = std::abs(inertia - inertia_) <= 0.2 * inertia_;
  if (is_linear ? inertia == inertia_ : close) iterate.factor = factor_;
}

void KeptFactor::take(const Iterate& iterate, double inertia) {
  const bool is_new = iterate.factor != factor_;
  const double of_step = iterate.cost - (is_new ? 0 : cost_);
  steps_ = is_new ? 1 : steps_ + 1;
  cost_ = iterate.cost;
  inertia_ = inertia;
  factor_ = of_step > cost_ / steps_ ? nullptr : iterate.factor;
}

}  // namespace fpi::fluid
