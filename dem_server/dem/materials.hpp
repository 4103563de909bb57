/// What pairs of materials make of a contact: 1/E* = Σ (1 − ν²)/E, 1/G* = Σ (2 − ν)/G, the geometric mean of
/// the restitutions, and the smaller friction and rolling friction of the two. Also what theory says of an
/// impact, by which damping and sub-steps are chosen.
#pragma once

#include <vector>

#include "dem/contact_law.hpp"
#include "scene/dem.hpp"

namespace fpi::dem {

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

/// Impact speed [m/s] with the energy of motion and compression that the contact has now.
double equivalent_speed(const PairLaw& law, const Normal& contact);

}  // namespace fpi::dem
