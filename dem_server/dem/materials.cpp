#include "dem/materials.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::dem {

PairLaw combine(const scene::Material& a, const scene::Material& b) {
  const auto normal_compliance = [](const scene::Material& m) {
    return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  };
  const auto shear_compliance = [](const scene::Material& m) {
    return (2 - m.poisson_ratio) * 2 * (1 + m.poisson_ratio) / m.youngs_modulus;
  };
  return {.normal_modulus = 1 / (normal_compliance(a) + normal_compliance(b)),
          .shear_modulus = 1 / (shear_compliance(a) + shear_compliance(b)),
          .damping_ratio = damping_ratio(std::sqrt(a.restitution * b.restitution)),
          .friction = std::min(a.friction, b.friction),
          .rolling_friction = std::min(a.rolling_friction, b.rolling_friction)};
}

LawTable::LawTable(const std::vector<scene::Material>& materials) : n_(materials.size()) {
  for (const auto& a : materials) {
    for (const auto& b : materials) laws_.push_back(combine(a, b));
  }
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
  return 2.868266 * std::pow(m_over_e * m_over_e / (radius * speed), 0.2);
}

double equivalent_speed(const PairLaw& law, const Normal& c) {
  const double compressed = std::max(c.overlap, 0.0);
  const double energy =
      0.4 * hertz_stiffness(law, c.radius) * compressed * compressed * std::sqrt(compressed);  // [J]
  return std::sqrt(c.rate * c.rate + 2 * energy / c.mass);
}

}  // namespace fpi::dem
