#include "fluid/kept_factor.hpp"

#include <gtest/gtest.h>

namespace fpi::fluid {
namespace {

struct FakeFactor : Factor {
  FakeFactor() : Factor(1) {}
  Vector back_solve(const Vector& b, Form) const override { return b; }
};

constexpr double inertia = 100;

std::shared_ptr<const Factor> lent(const KeptFactor& kept, double now, bool is_linear) {
  Iterate iterate;
  kept.lend(iterate, now, is_linear);
  return iterate.factor;
}

TEST(KeptFactor, is_dropped_by_the_step_that_costs_more_than_the_average) {
  KeptFactor kept;
  Iterate iterate{{}, std::make_shared<FakeFactor>(), 10};  // the factor and the first step
  kept.take(iterate, inertia);
  for (const double of_step : {1.0, 2.0, 3.0}) {  // averages 5.5, 4.33, 4
    ASSERT_TRUE(lent(kept, inertia, false));
    iterate.cost += of_step;
    kept.take(iterate, inertia);
  }
  ASSERT_TRUE(lent(kept, inertia, false));
  iterate.cost += 5;  // average 4.2
  kept.take(iterate, inertia);
  EXPECT_FALSE(lent(kept, inertia, false));
}

TEST(KeptFactor, serves_a_linear_problem_only_with_the_same_inertia) {
  KeptFactor kept;
  kept.take({{}, std::make_shared<FakeFactor>(), 1}, inertia);
  EXPECT_TRUE(lent(kept, inertia, true));
  EXPECT_FALSE(lent(kept, 1.01 * inertia, true));
  EXPECT_TRUE(lent(kept, 1.15 * inertia, false));
  EXPECT_FALSE(lent(kept, 2 * inertia, false));
  EXPECT_FALSE(lent(kept, 0 * inertia, false));
}

}  // namespace
}  // namespace fpi::fluid
