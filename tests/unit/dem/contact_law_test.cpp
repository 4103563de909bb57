#include <gtest/gtest.h>

#include <cmath>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::material;

template <class Real>
Real force_on(const PairLawOf<Real>& law, const NormalOf<Real>& c, double sub_step) {
  return normal_force<Hertz>(law, c, mean_over<Hertz>(c.overlap, Real(sub_step * c.rate)), sub_step);
}

TEST(ContactLaw, damping_ratio_inverts_restitution) {
  for (const double e : {1e-6, 0.01, 0.1, std::exp(-2.0), 0.5, 0.9, 0.999, 1.0}) {
    EXPECT_NEAR(restitution(damping_ratio(e)) / e, 1, 1e-9) << e;
  }
  EXPECT_EQ(damping_ratio(1), 0);
}

TEST(ContactLaw, restitution_is_continuous_at_critical_damping) {
  EXPECT_NEAR(restitution(1 - 1e-7), restitution(1 + 1e-7), 1e-6);
  EXPECT_NEAR(restitution(1), std::exp(-2.0), 1e-15);
}

TEST(ContactLaw, materials_combine_by_the_stated_rules) {
  const PairLaw law = combine(material(2e9, 0.25, 0.4, 0.5, 0.2), material(4e9, 0.3, 0.9, 0.3, 0.1));
  EXPECT_NEAR(1 / law.normal, 0.9375 / 2e9 + 0.91 / 4e9, 1e-24);
  const double G = 1 / (1.75 * 2.5 / 2e9 + 1.7 * 2.6 / 4e9);
  EXPECT_NEAR(law.tangential_ratio, 4 * G / law.normal, 1e-14);
  EXPECT_NEAR(restitution(law.damping_ratio), 0.6, 1e-12);
  EXPECT_EQ(law.friction, 0.3);
  EXPECT_EQ(law.rolling_friction, 0.1);
}

TEST(ContactLaw, normal_force_at_rest_is_hertz) {
  const PairLaw law = combine(material(1e9, 0.25, 0.5), material(1e9, 0.25, 0.5));
  const Normal state{.mass = 1, .radius = 0.01, .overlap = 1e-5, .rate = 0};
  const double expected = 4.0 / 3 * law.normal * 0.1 * std::pow(1e-5, 1.5);
  EXPECT_NEAR(force_on(law, state, 1e-12) / expected, 1, 1e-13);
}

TEST(ContactLaw, normal_force_never_pulls) {
  const PairLaw law = combine(material(1e9, 0.25, 0.1), material(1e9, 0.25, 0.1));
  EXPECT_EQ(force_on(law, Normal{.mass = 1, .radius = 0.01, .overlap = 1e-7, .rate = -1}, 1e-9), 0);
}

TEST(ContactLaw, nothing_acts_before_surfaces_meet) {
  const PairLaw law = combine(material(1e9, 0.25, 0.5), material(1e9, 0.25, 0.5));
  const Normal apart{.mass = 1, .radius = 0.01, .overlap = -1e-5, .rate = 1, .acceleration = 1e3};
  for (const double way : {1e-6, 1.9e-5}) {
    EXPECT_EQ(normal_force<Linear>(law, apart, mean_over<Linear>(apart.overlap, way), way), 0) << way;
    EXPECT_EQ(normal_force<Hertz>(law, apart, mean_over<Hertz>(apart.overlap, way), way), 0) << way;
  }
}

TEST(ContactLaw, mean_slope_is_what_the_force_gains_on_the_way) {
  for (const double way : {1e-7, 4.9e-7, 5.1e-7, 1e-6, 3e-6}) {
    const double before = std::max(1e-6 - 0.5 * way, 0.0), after = 1e-6 + 0.5 * way;
    EXPECT_NEAR(mean_over<Hertz>(1e-6, way).slope * way / (Hertz::force(after) - Hertz::force(before)), 1,
                1e-7);
    EXPECT_NEAR(mean_over<Linear>(1e-6, way).slope * way / (after - before), 1, 1e-14);
  }
}

TEST(ContactLaw, equivalent_speed_is_that_of_the_impact_all_along) {
  const PairLaw law = combine(material(1e9, 0.25), material(1e9, 0.25));
  const Normal start{.mass = 2, .radius = 0.01, .overlap = 0, .rate = 3};
  const double k = 4.0 / 3 * law.normal * 0.1;
  const double deepest = std::pow(1.25 * 2 * 9 / k, 0.4);
  const Normal turning{.mass = 2, .radius = 0.01, .overlap = deepest, .rate = 0};
  EXPECT_NEAR(equivalent_speed(law, start), 3, 1e-14);
  EXPECT_NEAR(equivalent_speed(law, turning), 3, 1e-12);
}

TEST(ContactLaw, a_spring_past_its_limit_slips_and_keeps_what_the_limit_carries) {
  const Vec3 rest = Vec3::Zero();
  Vec3 stretch(3e-3, 4e-3, 0);
  const Vec3 stuck = stick_slip({1000, 0}, 10.0, rest, stretch);
  EXPECT_EQ(stuck, Vec3(-3, -4, 0));
  const Vec3 slipping = stick_slip({1000, 0}, 1.0, rest, stretch);
  EXPECT_LT((slipping - Vec3(-0.6, -0.8, 0)).norm(), 1e-14);
  EXPECT_LT((stretch - Vec3(0.6e-3, 0.8e-3, 0)).norm(), 1e-17);
}

TEST(ContactLaw, four_contacts_at_once_have_what_each_has_alone) {
  PairLawOf<Lanes> laws;
  NormalOf<Lanes> states;
  std::array<double, n_lanes> alone;
  for (int i = 0; i < n_lanes; ++i) {
    const PairLaw law = combine(material(1e9, 0.2, 0.2 + 0.2 * i), material(2e9, 0.3, 0.5));
    const Normal state{.mass = 1.0 + i, .radius = 0.01, .overlap = 1e-6 * (i - 1), .rate = 1 - 0.6 * i};
    alone[i] = force_on(law, state, 1e-6);
    part(laws.normal, i) = law.normal;
    part(laws.damping_ratio, i) = law.damping_ratio;
    part(states.mass, i) = state.mass;
    part(states.radius, i) = state.radius;
    part(states.overlap, i) = state.overlap;
    part(states.rate, i) = state.rate;
  }
  const Lanes together = force_on(laws, states, 1e-6);
  for (int i = 0; i < n_lanes; ++i) EXPECT_NEAR(together[i], alone[i], 1e-12 * alone[i]) << i;
}

}  // namespace
}  // namespace fpi::dem
