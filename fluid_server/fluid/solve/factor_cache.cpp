#include "fluid/solve/factor_cache.hpp"

#include <cmath>

namespace fpi::fluid {

Corrector FactorCache::lend(double inertia, bool is_same_system) const {
  if (!corrector_.reference) return {};
  const double before = corrector_.reference->layout.inertia;
  if (std::abs(inertia - before) > 0.2 * before) return {};
  Corrector lent = corrector_;
  lent.is_exact = lent.is_exact && is_same_system && inertia == before;
  if (!is_same_system) lent.factor = nullptr;
  if (!is_forgotten_) return lent;
  if (!lent.is_exact || !lent.factor) return {};
  lent.cost = lent.factor->factor_cost();
  return lent;
}

void FactorCache::take(const Corrector& corrector) {
  const bool is_new = is_forgotten_ || corrector.reference != corrector_.reference;
  const double of_step = corrector.cost - (is_new ? 0 : corrector_.cost);
  steps_ = is_new ? 1 : steps_ + 1;
  corrector_ = of_step > corrector.cost / steps_ ? Corrector{} : corrector;
  is_forgotten_ = false;
}

}  // namespace fpi::fluid
