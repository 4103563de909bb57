#include "fluid/kept_factor.hpp"

#include <cmath>

namespace fpi::fluid {

Corrector KeptFactor::lend(double inertia, bool is_same_system) const {
  if (std::abs(inertia - inertia_) > 0.2 * inertia_) return {};
  Corrector lent = corrector_;
  lent.is_exact = lent.is_exact && is_same_system && inertia == inertia_;
  if (!is_same_system) lent.factor = nullptr;
  return lent;
}

void KeptFactor::take(const Corrector& corrector, double inertia) {
  const bool is_new = corrector.background != corrector_.background;
  const double of_step = corrector.cost - (is_new ? 0 : corrector_.cost);
  steps_ = is_new ? 1 : steps_ + 1;
  inertia_ = inertia;
  corrector_ = of_step > corrector.cost / steps_ ? Corrector{} : corrector;
}

}  // namespace fpi::fluid
