#include "dem/model/materials.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fpi::dem {
namespace {

constexpr double hertz_duration = 2.868266;  ///< of an impact, times (m*²/(R* E*² v))^(1/5)

/// Of equivalent_speed; 2/m* times the energy of a Hertz contact is 16/15 E* √(R* δ) δ²/m*.
double squared_equivalent_speed(const PairLaw& law, const Normal& c) {
  const double overlap = std::max(c.overlap, 0.0);
  return c.rate * c.rate +
         16.0 / 15 * law.normal * std::sqrt(c.radius * overlap) * overlap * overlap / c.mass;
}

}  // namespace

PairLaw combine(const scene::Material& a, const scene::Material& b, Elasticity elasticity) {
  const bool linear = elasticity == Elasticity::linear;
  // Of linear springs only the ratio κ needs a modulus, and any measure of stiffness will do.
  const auto modulus = [&](const scene::Material& m) {
    return linear ? m.normal_stiffness : m.youngs_modulus;
  };
  const auto normal_compliance = [&](const scene::Material& m) {
    return (1 - m.poisson_ratio * m.poisson_ratio) / modulus(m);
  };
  const auto shear_compliance = [&](const scene::Material& m) {
    return (2 - m.poisson_ratio) * 2 * (1 + m.poisson_ratio) / modulus(m);
  };
  const double compliance = normal_compliance(a) + normal_compliance(b);
  return {.normal = linear ? 2 / (1 / modulus(a) + 1 / modulus(b)) : 1 / compliance,
          .tangential_ratio = 4 * compliance / (shear_compliance(a) + shear_compliance(b)),
          .damping_ratio = damping_ratio(std::sqrt(a.restitution * b.restitution)),
          .friction = std::min(a.friction, b.friction),
          .rolling_friction = std::min(a.rolling_friction, b.rolling_friction),
          .twisting_friction = std::min(a.twisting_friction, b.twisting_friction),
          .adhesion = std::sqrt(a.adhesion * b.adhesion)};
}

std::vector<scene::Material> stretched(std::vector<scene::Material> materials, double stretch) {
  if (stretch == 1) return materials;
  for (scene::Material& m : materials) {
    m.youngs_modulus *= std::pow(stretch, -2.5);
    m.normal_stiffness /= stretch * stretch;
  }
  return materials;
}

LawTable::LawTable(const std::vector<scene::Material>& materials, Elasticity elasticity)
    : n_(materials.size()) {
  for (const auto& a : materials) {
    for (const auto& b : materials) laws_.push_back(combine(a, b, elasticity));
  }
}

bool LawTable::resists_turning() const {
  return std::ranges::any_of(
      laws_, [](const PairLaw& law) { return law.rolling_friction > 0 || law.twisting_friction > 0; });
}

double restitution(double zeta) {
  const double w = std::abs(1 - zeta * zeta);
  if (w < 1e-12) return std::exp(-2.0);
  return std::exp(-2 * zeta * (zeta < 1 ? std::acos(zeta) : std::acosh(zeta)) / std::sqrt(w));
}

double damping_ratio(double e) {
  if (e >= 1) return 0;
  double low = 0, high = 1 / std::sqrt(e);  // restitution(high) < e, since e ~ 1/(4ζ²) for large ζ
  double middle = 0.5 * high;
  while (low < middle && middle < high) {
    (restitution(middle) > e ? low : high) = middle;
    middle = 0.5 * (low + high);
  }
  return middle;
}

double contact_time(double mass, double radius, double normal_modulus, double speed) {
  const double m_over_e = mass / normal_modulus;
  return hertz_duration * std::pow(m_over_e * m_over_e / (radius * speed), 0.2);
}

double equivalent_speed(const PairLaw& law, const Normal& c) {
  return std::sqrt(squared_equivalent_speed(law, c));
}

double contact_time(Elasticity elasticity, const PairLaw& law, const Normal& c) {
  if (elasticity == Elasticity::linear)
    return std::numbers::pi * std::sqrt(c.mass / Linear::stiffness(law.normal, c.radius));
  return contact_time(c.mass, c.radius, law.normal, equivalent_speed(law, c));
}

bool lasts_longer(Elasticity elasticity, const PairLaw& law, const Normal& contact, double time) {
  if (elasticity == Elasticity::linear) return contact_time(elasticity, law, contact) > time;
  const double m_over_e = contact.mass / law.normal, share = time / hertz_duration, squared = share * share;
  const double speed = m_over_e * m_over_e / (squared * squared * share * contact.radius);  // lasts `time`
  return squared_equivalent_speed(law, contact) < speed * speed;
}

}  // namespace fpi::dem
