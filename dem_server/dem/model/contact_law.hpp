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

/// F = k δ^(3/2), k = 4/3 E* √R* [N/m^(3/2)]. All else is over k, at δ ≥ 0: F, dF/dδ, and the amplitude s
/// with ½ s² = energy. Over overlaps from δ(1 − r) to δ(1 + r) the mean of F and of ds/dδ are their values at
/// δ times a factor: binomial series in r², good to 3e-8 up to r = ¼. So is that of dF/dδ.
struct Hertz {
  template <class Real>
  static Real stiffness(Real modulus, Real radius) {
    return 4.0 / 3 * modulus * sqrt(radius);
  }
  template <class Real>
  static Real force(Real overlap) {
    return overlap * sqrt(overlap);
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
  template <class Real>
  static Real mean_force_factor(Real r2) {
    return 1 + r2 * (0.125 + r2 * (0.0046875 + r2 * 0.0009765625));
  }
  template <class Real>
  static Real mean_slope_factor(Real r2) {
    return 1 - r2 * (1.0 / 24 + r2 * (0.0078125 + r2 * 0.0029296875));
  }
  template <class Real>
  static Real mean_amplitude_slope_factor(Real r2) {
    return 1 - r2 * (0.03125 + r2 * (0.00751953125 + r2 * 0.0031890869140625));
  }
};

/// F = k δ, k [N/m].
struct Linear {
  template <class Real>
  static Real stiffness(Real spring, Real) {
    return spring;
  }
  template <class Real>
  static Real force(Real overlap) {
    return overlap;
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
  template <class Real>
  static Real mean_force_factor(Real) {
    return Real{} + 1;
  }
  template <class Real>
  static Real mean_slope_factor(Real) {
    return Real{} + 1;
  }
  template <class Real>
  static Real mean_amplitude_slope_factor(Real) {
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

/// What a contact has on average over a sub-step, in which its overlap grows by a `way` [m]. Force and
/// damping have infinite curvature or slope at δ = 0, dF/dδ of the linear law jumps there; their means are
/// continuous, and do not depend on where in a sub-step the contact starts. Where surfaces meet or part
/// within it the mean overlap is positive: the force acts and so does friction.
template <class Real>
struct MeanOf {
  Real overlap;           ///< of both ends [m]
  Real slope;             ///< dF/dδ, over k
  Real force;             ///< elastic, over k
  Real amplitude_change;  ///< from end to end
};
using Mean = MeanOf<double>;

/// From the values at both ends.
template <class Elastic, class Real>
MeanOf<Real> mean_of_ends(Real overlap, Real way) {
  const Real before = max(overlap - 0.5 * way, Real{}), after = max(overlap + 0.5 * way, Real{});
  const Real mean = 0.5 * (before + after);
  const Real s0 = Elastic::amplitude(before), s1 = Elastic::amplitude(after), change = s1 - s0;
  const Real force = select(way == 0, Elastic::force(mean), 0.5 * (s0 + s1) * change / way);
  const Real at_rest = select(mean > 0, Elastic::slope(mean), Real{});
  const Real slope = select(way == 0, at_rest, (Elastic::force(after) - Elastic::force(before)) / way);
  return {mean, slope, force, change};
}

/// Most contacts go a small part of their overlap, and need no values at the ends.
template <class Elastic, class Real>
MeanOf<Real> mean_over(Real overlap, Real way) {
  const auto little = abs(way) < 0.5 * abs(overlap);
  const Real compressed = max(overlap, Real{}), r = 0.5 * way / overlap, r2 = r * r;
  const Real touches = select(overlap > 0, Real{} + 1, Real{});  // or not, all along
  const MeanOf<Real> around{
      compressed, touches * Elastic::slope(compressed) * Elastic::mean_slope_factor(r2),
      Elastic::force(compressed) * Elastic::mean_force_factor(r2),
      touches * Elastic::amplitude_slope(compressed) * Elastic::mean_amplitude_slope_factor(r2) * way};
  if (holds_everywhere(little)) return around;
  const MeanOf<Real> ends = mean_of_ends<Elastic>(overlap, way);
  return {select(little, around.overlap, ends.overlap), select(little, around.slope, ends.slope),
          select(little, around.force, ends.force),
          select(little, around.amplitude_change, ends.amplitude_change)};
}

/// Share of a time in which the overlap has grown by a `way` [m] to what it is [m] that the surfaces touched.
template <class Real>
Real share_in_contact(Real overlap, Real way) {
  const Real share = select(way >= 0, overlap / way, 1 - overlap / way);
  return select(share > 0, select(share < 1, share, Real{} + 1),
                Real{});  // 0 / 0 of what just meets at rest: 0
}

/// d²δ/dt² [m/s²] now: what it was `elapsed` [s] ago, and what the pair's own spring has added since.
template <class Elastic, class Real>
Real acceleration_now(const PairLawOf<Real>& law, const NormalOf<Real>& c, Real before, double elapsed) {
  const Real stiffness = Elastic::stiffness(law.normal, c.radius) * Elastic::slope(max(c.overlap, Real{}));
  return before - elapsed * stiffness / c.mass * c.rate;
}

/// Normal force [N], never attractive: F + Δt²/12 F' d²δ/dt² + 2 ζ √(k m*) ds/dt, F = k s ds/dδ, of which the
/// first and the last are means over the sub-step Δt [s] around now.
///
/// The second term takes the error out of the Hamiltonian that velocity Verlet keeps (Rowlands 1991;
/// Takahashi & Imada 1984), so that an impact without damping has time and speed of fourth order; at rest it
/// is zero. With the amplitude s as coordinate the damped contact is a linear oscillator (Tsuji 1992; Antypov
/// & Elliott 2011).
template <class Elastic, class Real>
Real normal_force(const PairLawOf<Real>& law, const NormalOf<Real>& c, const MeanOf<Real>& mean,
                  double sub_step) {
  const Real k = Elastic::stiffness(law.normal, c.radius);
  const Real shift = sub_step * sub_step / 12 * c.acceleration;
  const Real elastic = k * (mean.force + mean.slope * shift);
  return max(elastic + 2 / sub_step * law.damping_ratio * sqrt(k * c.mass) * mean.amplitude_change, Real{});
}

/// What of the normal force [N] there would be without damping.
template <class Elastic, class Real>
Real elastic_force(PairLawOf<Real> law, const NormalOf<Real>& c, const MeanOf<Real>& mean, double sub_step) {
  law.damping_ratio = Real{};
  return normal_force<Elastic>(law, c, mean, sub_step);
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

/// κ dF/dδ [N/m], dF/dδ = k `slope`: for Hertz Mindlin's 8 G* √(R* δ).
template <class Elastic, class Real>
SpringOf<Real> tangential_spring(const PairLawOf<Real>& law, const NormalOf<Real>& c, Real slope) {
  const Real stiffness = law.tangential_ratio * Elastic::stiffness(law.normal, c.radius) * slope;
  return damped<Real>(law.damping_ratio, stiffness, c.mass);
}

/// Rolling or twisting stiffness k_t R*² [N m/rad]; `inertia` is that of the pair, as m* of masses [kg m²].
template <class Real>
SpringOf<Real> turning_spring(const PairLawOf<Real>& law, const NormalOf<Real>& c,
                              const SpringOf<Real>& tangential, Real inertia) {
  return damped<Real>(law.damping_ratio, tangential.stiffness * c.radius * c.radius, inertia);
}

/// Of a vector, or of its only component.
template <class Real, class Vector>
Real squared_length(const Vector& v) {
  if constexpr (std::is_same_v<Vector, Real>)
    return v * v;
  else
    return v.dot(v);
}

/// Share of a force that a limit leaves of it: 1 within the limit.
template <class Real, class Vector>
Real share_within(Real limit, const Vector& force) {
  const Real squared = squared_length<Real>(force);
  const auto beyond = squared > limit * limit;
  if (holds_nowhere(beyond)) return Real{} + 1;
  return select(beyond, limit / sqrt(squared), Real{} + 1);
}

/// Force or moment of a spring and dashpot with a limit. Past the limit the spring slips: `stretch` is
/// shortened to what the limit carries. The dashpot has no history, or fast sliding would wind the spring up
/// against it and end below the limit.
template <class Real, class Vector>
Vector stick_slip(const SpringOf<Real>& spring, Real limit, const Vector& rate, Vector& stretch) {
  stretch = share_within(limit, Vector(spring.stiffness * stretch)) * stretch;
  const Vector trial = -spring.stiffness * stretch - spring.damping * rate;
  return share_within(limit, trial) * trial;
}

}  // namespace fpi::dem
