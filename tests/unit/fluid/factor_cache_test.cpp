#include "fluid/solve/factor_cache.hpp"

#include <gtest/gtest.h>

namespace fpi::fluid {
namespace {

struct FakeFactor : Factor {
  FakeFactor() : Factor(1) {}
  Vector back_solve(const Vector& b, Form) const override { return b; }
};

constexpr double inertia = 100;

Corrector exact(double cost) {
  const auto factor = std::make_shared<FakeFactor>();
  return {factor, std::make_shared<Background>(factor, Layout{{}, {}, {}, {}, inertia}), true, cost};
}

TEST(FactorCache, is_dropped_by_the_step_that_costs_more_than_the_average) {
  FactorCache kept;
  Corrector corrector = exact(10);  // the factor and the first step
  kept.take(corrector);
  for (const double of_step : {1.0, 2.0, 3.0}) {  // averages 5.5, 4.33, 4
    ASSERT_TRUE(kept.lend(inertia, true).factor);
    corrector.cost += of_step;
    kept.take(corrector);
  }
  ASSERT_TRUE(kept.lend(inertia, true).factor);
  corrector.cost += 5;  // average 4.2
  kept.take(corrector);
  EXPECT_FALSE(kept.lend(inertia, true).factor);
  EXPECT_FALSE(kept.lend(inertia, false).reference);
}

TEST(FactorCache, is_exact_only_with_the_same_inertia_and_in_the_same_system) {
  FactorCache kept;
  kept.take(exact(1));
  EXPECT_TRUE(kept.lend(inertia, true).is_exact);
  EXPECT_FALSE(kept.lend(1.01 * inertia, true).is_exact);
  EXPECT_FALSE(kept.lend(inertia, false).is_exact);
}

TEST(FactorCache, serves_with_an_inertia_that_is_near) {
  FactorCache kept;
  kept.take(exact(1));
  EXPECT_TRUE(kept.lend(1.15 * inertia, true).factor);
  for (const bool is_same_system : {true, false}) {
    EXPECT_FALSE(kept.lend(2 * inertia, is_same_system).reference);
    EXPECT_FALSE(kept.lend(0 * inertia, is_same_system).reference);
  }
}

TEST(FactorCache, is_the_background_alone_for_another_system) {
  FactorCache kept;
  const Corrector taken = exact(1);
  kept.take(taken);
  const Corrector lent = kept.lend(inertia, false);
  EXPECT_FALSE(lent.factor);
  EXPECT_EQ(lent.reference, taken.reference);
  EXPECT_EQ(lent.cost, 1);
}

TEST(FactorCache, averages_over_all_factors_made_from_one_background) {
  FactorCache kept;
  Corrector corrector = exact(10);
  kept.take(corrector);
  corrector.factor = std::make_shared<FakeFactor>();  // corrected
  corrector.cost += 4;                                // average 7
  kept.take(corrector);
  EXPECT_TRUE(kept.lend(inertia, false).reference);
  corrector = exact(3);  // a new reference begins a new average
  kept.take(corrector);
  EXPECT_TRUE(kept.lend(inertia, false).reference);
}

}  // namespace
}  // namespace fpi::fluid
