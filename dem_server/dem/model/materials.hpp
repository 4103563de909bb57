/// What pairs of materials make of a contact: 1/E* = Σ (1 − ν²)/E and 1/G* = Σ (2 − ν)/G, or the harmonic
/// mean of the linear stiffnesses; κ = 4 G*/E*; the geometric means of restitution and adhesion; the smaller
/// of the frictions. Also what theory says of an impact, by which damping and sub-steps are chosen.
#pragma once

#include <algorithm>
#include <vector>

#include "dem/model/contact_law.hpp"
#include "scene/dem.hpp"

namespace fpi::dem {

PairLaw combine(const scene::Material& a, const scene::Material& b,
                Elasticity elasticity = Elasticity::hertz);

/// Materials so much softer that every impact lasts `stretch` times as long, as t_c goes with E^(−2/5) and
/// k_n^(−1/2). Damping ratios, and with them restitutions, stay; impacts overlap `stretch` times as far.
std::vector<scene::Material> stretched(std::vector<scene::Material> materials, double stretch);

/// The law of every pair of materials, by their indices.
class LawTable {
 public:
  explicit LawTable(const std::vector<scene::Material>& materials, Elasticity elasticity = Elasticity::hertz);
  /// True where some pair of materials sticks.
  bool adhesive() const {
    return std::ranges::any_of(laws_, [](const PairLaw& law) { return law.adhesion > 0; });
  }
  const PairLaw& operator()(std::size_t a, std::size_t b) const { return laws_[a * n_ + b]; }
  std::size_t n_materials() const { return n_; }
  /// Whether any pair resists rolling or twisting.
  bool resists_turning() const;

 private:
  std::size_t n_;
  std::vector<PairLaw> laws_;
};

/// Restitution of a contact with damping ratio ζ, at any speed, the same for Hertz and linear springs. The
/// contact ends when its force has fallen to zero, so it never pulls: e = exp(−2ζ acos ζ/√(1 − ζ²)), with
/// acosh and ζ² − 1 where ζ > 1 (Schwager & Pöschel 2007).
double restitution(double damping_ratio);
/// Its inverse, ζ(e) for 0 < e ≤ 1.
double damping_ratio(double restitution);

/// Duration t_c of an undamped Hertz impact [s]: 2.868266 (m*²/(R* E*² v))^(1/5); infinite at v = 0.
double contact_time(double mass, double radius, double normal_modulus, double speed);

/// Impact speed [m/s] with the energy of motion and compression that a Hertz contact has now.
double equivalent_speed(const PairLaw& law, const Normal& contact);
/// Duration [s] of the undamped impact with that energy; of a linear spring π √(m*/k).
double contact_time(Elasticity elasticity, const PairLaw& law, const Normal& contact);
/// Whether it lasts longer than `time` [s]: cheaper than its duration.
bool lasts_longer(Elasticity elasticity, const PairLaw& law, const Normal& contact, double time);

}  // namespace fpi::dem
