/// The contact of two spheres, or of a sphere and a plane (R* = R), as free functions of values. Normal:
/// Hertz with Tsuji's damping; tangential: Mindlin's stiffness with Coulomb's limit; rolling: spring, dashpot
/// and limit. Discs touch by the same law as spheres of their radius.
///
/// A pair of materials has 1/E* = Σ (1 − ν²)/E, 1/G* = Σ (2 − ν)/G, the geometric mean of the restitutions,
/// and the smaller friction and rolling friction of the two.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/dem.hpp"

namespace fpi::dem {

using Vec3 = Eigen::Vector3d;

/// What two materials make of a contact.
struct PairLaw {
  double normal_modulus = 0;    ///< E* [Pa]
  double shear_modulus = 0;     ///< G* [Pa]
  double damping_ratio = 0;     ///< ζ of the restitution asked for
  double friction = 0;          ///< μ
  double rolling_friction = 0;  ///< μ_r
};
PairLaw combine(const scene::Material& a, const scene::Material& b);

/// The law of every pair of materials, by their indices.
class LawTable {
 public:
  explicit LawTable(const std::vector<scene::Material>& materials);
  const PairLaw& operator()(std::size_t a, std::size_t b) const { return laws_[a * n_ + b]; }

 private:
  std::size_t n_;
  std::vector<PairLaw> laws_;
};

/// Restitution of the damped Hertz contact with damping ratio ζ, at any speed. With s = δ^(5/4) as coordinate
/// and a time stretched by δ^(-1/4) Tsuji's contact is a linear oscillator (Antypov & Elliott 2011). The
/// contact ends when its force has fallen to zero, so it never pulls: e = exp(−2ζ acos ζ/√(1 − ζ²)), with
/// acosh and ζ² − 1 where ζ > 1 (Schwager & Pöschel 2007 for the linear dashpot).
double restitution(double damping_ratio);
/// Its inverse, ζ(e) for 0 < e ≤ 1.
double damping_ratio(double restitution);

/// Duration t_c of an undamped impact [s]: 2.868266 (m*²/(R* E*² v))^(1/5); infinite at v = 0.
double contact_time(double mass, double radius, double normal_modulus, double speed);

/// Normal state of one contact.
struct Normal {
  double mass;     ///< m* [kg]
  double radius;   ///< R* [m]
  double overlap;  ///< δ [m]
  double rate;     ///< dδ/dt [m/s]
};

/// Impact speed [m/s] with the energy of motion and compression that the contact has now.
double equivalent_speed(const PairLaw& law, const Normal& contact);

/// Normal force [N], never attractive: 4/3 E* √R* δ^(3/2) + √5 ζ √(m* 4/3 E* √R*) δ^(1/4) dδ/dt. The damping
/// starts with infinite slope at δ = 0; it is averaged over the sub-step Δt [s] around now, for which it is
/// the difference of 4/5 δ^(5/4) over its ends, so that the restitution does not depend on where in a
/// sub-step the contact starts.
double normal_force(const PairLaw& law, const Normal& contact, double sub_step);

/// Force or moment of a spring and dashpot with a limit. Past the limit it slips, and `stretch` is shortened
/// to what the limit carries.
Vec3 stick_slip(double stiffness, double damping, double limit, const Vec3& rate, Vec3& stretch);

/// Spring and dashpot along the surface or about the contact.
struct Spring {
  double stiffness, damping;
};
/// Mindlin's tangential stiffness 8 G* √(R* δ) [N/m], damped at the ratio of the normal contact.
Spring tangential_spring(const PairLaw& law, const Normal& contact);
/// Rolling stiffness k_t R*² [N m/rad]; `inertia` is that of the pair, as m* of masses [kg m²].
Spring rolling_spring(const PairLaw& law, const Normal& contact, const Spring& tangential, double inertia);

}  // namespace fpi::dem
