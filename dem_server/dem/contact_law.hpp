/// The contact of two spheres, or of a sphere and a plane (R* = R), as free functions of values. Normal: an
/// elastic law with damping; tangential: Mindlin's spring with Coulomb's limit; rolling and twisting: spring,
/// dashpot and limit. Discs touch by the same law as spheres of their radius.
///
/// Real is double for one contact, Lanes for several at once; a Vector has three of them. Elastic, the law
/// of the scene, is Hertz or Linear.
#pragma once

#include <type_traits>

#include "core/lanes.hpp"

namespace fpi::dem {

/// What two materials make of a contact.
template <class Real>
struct PairLawOf {
  Real normal{};             ///< of Hertz E* [Pa], of a linear spring k_n [N/m]
  Real tangential_ratio{};   ///< κ = k_t/(dF/dδ)
  Real damping_ratio{};      ///< ζ of the restitution asked for
  Real friction{};           ///< μ
  Real rolling_friction{};   ///< μ_r
  Real twisting_friction{};  ///< μ_t
  Real adhesion{};           ///< w, work of adhesion [J/m²]
};
using PairLaw = PairLawOf<double>;

/// Normal state of a contact.
template <class Real>
struct NormalOf {
  Real mass;            ///< m* [kg]
  Real radius;          ///< R* [m]
  Real overlap;         ///< δ [m]
  Real rate;            ///< dδ/dt [m/s]
  Real acceleration{};  ///< d²δ/dt² [m/s²]; zero leaves the integrator its error of second order
};
using Normal = NormalOf<double>;

/// F = k δ^(3/2), k = 4/3 E* √R* [N/m^(3/2)]. All else is over k, at δ ≥ 0: dF/dδ, and the amplitude s with
/// ½ s² = energy.
struct Hertz {
  template <class Real>
  static Real stiffness(Real modulus, Real radius) {
    return 4.0 / 3 * modulus * sqrt(radius);
  }
  template <class Real>
  static Real slope(Real overlap) {
    return 1.5 * sqrt(overlap);
  }
  template <class Real>
  static Real amplitude(Real overlap) {
    return std::sqrt(0.8) * overlap * sqrt(sqrt(overlap));
  }
  template <class Real>
  static Real amplitude_slope(Real overlap) {
    return std::sqrt(1.25) * sqrt(sqrt(overlap));
  }
};

/// F = k δ, k [N/m].
struct Linear {
  template <class Real>
  static Real stiffness(Real spring, Real) {
    return spring;
  }
  template <class Real>
  static Real slope(Real) {
    return Real{} + 1;
  }
  template <class Real>
  static Real amplitude(Real overlap) {
    return overlap;
  }
  template <class Real>
  static Real amplitude_slope(Real) {
    return Real{} + 1;
  }
};

/// Which of them a scene has.
enum class Elasticity { hertz, linear };

/// Calls `use` with the law's type, so that what follows is compiled for it.
template <class Use>
auto with_elastic_law(Elasticity law, Use use) {
  return law == Elasticity::linear ? use(Linear{}) : use(Hertz{});
}

/// d²δ/dt² [m/s²] now: what it was `elapsed` [s] ago, and what the pair's own spring has added since.
template <class Elastic, class Real>
Real acceleration_now(const PairLawOf<Real>& law, const NormalOf<Real>& c, Real before, double elapsed) {
  const Real stiffness = Elastic::stiffness(law.normal, c.radius) * Elastic::slope(max(c.overlap, Real{}));
  return before - elapsed * stiffness / c.mass * c.rate;
}

/// Normal force [N], never attractive: F + Δt²/12 F' d²δ/dt² + 2 ζ √(k m*) ds/dt, F = k s ds/dδ.
///
/// The second term takes the error out of the Hamiltonian that velocity Verlet keeps (Rowlands 1991;
/// Takahashi & Imada 1984), so that an impact without damping has time and speed of fourth order; at rest it
/// is zero. With the amplitude s as coordinate the damped contact is a linear oscillator (Tsuji 1992; Antypov
/// & Elliott 2011). Force and damping have infinite curvature or slope at δ = 0; they are means over the
/// sub-step Δt [s] around now, so that the impact does not depend on where in a sub-step the contact starts.
template <class Elastic, class Real>
Real normal_force(const PairLawOf<Real>& law, const NormalOf<Real>& c, double sub_step) {
  const Real k = Elastic::stiffness(law.normal, c.radius);
  const Real compressed = max(c.overlap, Real{});
  const Real way = sub_step * c.rate;
  const Real before = Elastic::amplitude(max(c.overlap - 0.5 * way, Real{}));
  const Real after = Elastic::amplitude(max(c.overlap + 0.5 * way, Real{}));
  // Where next to nothing moves the difference quotient would be noise.
  const Real slope = select(max(way, -way) > 1e-5 * compressed, (after - before) / way,
                            Elastic::amplitude_slope(compressed));
  const Real elastic = 0.5 * k * (before + after) * slope;
  const Real shift = sub_step * sub_step / 12 * c.acceleration;
  const Real damping = 2 * law.damping_ratio * sqrt(k * c.mass) * (after - before) / sub_step;
  return max(elastic + k * Elastic::slope(compressed) * shift + damping, Real{});
}

/// Mean overlap [m] of the ends of a sub-step: where surfaces meet or part within it, the normal force acts
/// and so does friction.
template <class Real>
Real mean_overlap(const NormalOf<Real>& c, double sub_step) {
  const Real half = 0.5 * sub_step * c.rate;
  return 0.5 * (max(c.overlap + half, Real{}) + max(c.overlap - half, Real{}));
}

/// Spring and dashpot along the surface or about the contact.
template <class Real>
struct SpringOf {
  Real stiffness, damping;
};
using Spring = SpringOf<double>;

/// Dashpot of a spring on an inertia, at the damping ratio of the normal contact.
template <class Real>
SpringOf<Real> damped(Real damping_ratio, Real stiffness, Real inertia) {
  return {stiffness, 2 * std::sqrt(5.0 / 6) * damping_ratio * sqrt(stiffness * inertia)};
}

/// κ dF/dδ [N/m] at δ > 0: for Hertz Mindlin's 8 G* √(R* δ).
template <class Elastic, class Real>
SpringOf<Real> tangential_spring(const PairLawOf<Real>& law, const NormalOf<Real>& c) {
  const Real stiffness =
      law.tangential_ratio * Elastic::stiffness(law.normal, c.radius) * Elastic::slope(c.overlap);
  return damped<Real>(law.damping_ratio, stiffness, c.mass);
}

/// Rolling or twisting stiffness k_t R*² [N m/rad]; `inertia` is that of the pair, as m* of masses [kg m²].
template <class Real>
SpringOf<Real> turning_spring(const PairLawOf<Real>& law, const NormalOf<Real>& c,
                              const SpringOf<Real>& tangential, Real inertia) {
  return damped<Real>(law.damping_ratio, tangential.stiffness * c.radius * c.radius, inertia);
}

/// Length of a vector, or size of its only component.
template <class Real, class Vector>
Real length(const Vector& v) {
  if constexpr (std::is_same_v<Vector, Real>)
    return sqrt(v * v);
  else
    return sqrt(v.dot(v));
}

/// Share of a force that a limit leaves of it: 1 within the limit.
template <class Real, class Vector>
Real share_within(Real limit, const Vector& force) {
  const Real size = length<Real>(force);
  return select(size > limit, limit / size, Real{} + 1);
}

/// Force or moment of a spring and dashpot with a limit. Past the limit the spring slips: `stretch` is
/// shortened to what the limit carries. The dashpot has no memory, or fast sliding would wind the spring up
/// against it and end below the limit.
template <class Real, class Vector>
Vector stick_slip(const SpringOf<Real>& spring, Real limit, const Vector& rate, Vector& stretch) {
  const Vector elastic = spring.stiffness * stretch;
  stretch = share_within(limit, elastic) * stretch;
  const Vector trial = -spring.stiffness * stretch - spring.damping * rate;
  return share_within(limit, trial) * trial;
}

}  // namespace fpi::dem
