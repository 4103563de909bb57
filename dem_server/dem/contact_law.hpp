/// The contact of two spheres, or of a sphere and a plane (R* = R), as free functions of values. Normal:
/// Hertz with Tsuji's damping; tangential: Mindlin's stiffness with Coulomb's limit; rolling: spring, dashpot
/// and limit. Discs touch by the same law as spheres of their radius.
///
/// Real is double for one contact, Lanes for several at once; a Vector has three of them.
#pragma once

#include "core/lanes.hpp"

namespace fpi::dem {

/// What two materials make of a contact.
template <class Real>
struct PairLawOf {
  Real normal_modulus{};    ///< E* [Pa]
  Real shear_modulus{};     ///< G* [Pa]
  Real damping_ratio{};     ///< ζ of the restitution asked for
  Real friction{};          ///< μ
  Real rolling_friction{};  ///< μ_r
};
using PairLaw = PairLawOf<double>;

/// Normal state of a contact.
template <class Real>
struct NormalOf {
  Real mass;     ///< m* [kg]
  Real radius;   ///< R* [m]
  Real overlap;  ///< δ [m]
  Real rate;     ///< dδ/dt [m/s]
};
using Normal = NormalOf<double>;

/// 4/3 E* √R* of F = k δ^(3/2) [N/m^(3/2)].
template <class Real>
Real hertz_stiffness(const PairLawOf<Real>& law, Real radius) {
  return 4.0 / 3 * law.normal_modulus * sqrt(radius);
}

/// δ^(5/4), zero where there is no overlap.
template <class Real>
Real five_quarters(Real overlap) {
  const Real compressed = max(overlap, Real{});
  return compressed * sqrt(sqrt(compressed));
}

/// Normal force [N], never attractive: 4/3 E* √R* δ^(3/2) + √5 ζ √(m* 4/3 E* √R*) δ^(1/4) dδ/dt. The damping
/// starts with infinite slope at δ = 0; it is averaged over the sub-step Δt [s] around now, for which it is
/// the difference of 4/5 δ^(5/4) over its ends, so that the restitution does not depend on where in a
/// sub-step the contact starts.
template <class Real>
Real normal_force(const PairLawOf<Real>& law, const NormalOf<Real>& c, double sub_step) {
  const Real k = hertz_stiffness(law, c.radius);
  const Real compressed = max(c.overlap, Real{});
  const Real elastic = k * compressed * sqrt(compressed);
  const Real damping = sqrt(5 * c.mass * k) * law.damping_ratio;
  const Real half = 0.5 * sub_step * c.rate;
  const Real mean_rate = 0.8 * (five_quarters(c.overlap + half) - five_quarters(c.overlap - half)) / sub_step;
  return max(elastic + damping * mean_rate, Real{});
}

/// Spring and dashpot along the surface or about the contact.
template <class Real>
struct SpringOf {
  Real stiffness, damping;
};
using Spring = SpringOf<double>;

/// Dashpot of a spring on an inertia, damped at the ratio of the normal contact.
template <class Real>
SpringOf<Real> damped(Real damping_ratio, Real stiffness, Real inertia) {
  return {stiffness, 2 * std::sqrt(5.0 / 6) * damping_ratio * sqrt(stiffness * inertia)};
}

/// Mindlin's tangential stiffness 8 G* √(R* δ) [N/m].
template <class Real>
SpringOf<Real> tangential_spring(const PairLawOf<Real>& law, const NormalOf<Real>& c) {
  return damped<Real>(law.damping_ratio, 8 * law.shear_modulus * sqrt(c.radius * c.overlap), c.mass);
}

/// Rolling stiffness k_t R*² [N m/rad]; `inertia` is that of the pair, as m* of masses [kg m²].
template <class Real>
SpringOf<Real> rolling_spring(const PairLawOf<Real>& law, const NormalOf<Real>& c,
                              const SpringOf<Real>& tangential, Real inertia) {
  return damped<Real>(law.damping_ratio, tangential.stiffness * c.radius * c.radius, inertia);
}

/// Force or moment of a spring and dashpot with a limit. Past the limit it slips, and `stretch` is shortened
/// to what the limit carries.
template <class Real, class Vector>
Vector stick_slip(const SpringOf<Real>& spring, Real limit, const Vector& rate, Vector& stretch) {
  const Vector trial = -spring.stiffness * stretch - spring.damping * rate;
  const Real size = sqrt(trial.dot(trial));
  const Real share = select(size > limit, limit / size, Real{} + 1);
  stretch += (1 - share) / spring.stiffness * trial;
  return share * trial;
}

}  // namespace fpi::dem
