#include "dem/contact_law.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::dem {
namespace {

/// δ^(5/4), zero where there is no overlap.
double five_quarters(double overlap) { return overlap > 0 ? overlap * std::sqrt(std::sqrt(overlap)) : 0; }

/// 4/3 E* √R* of F = k δ^(3/2) [N/m^(3/2)].
double hertz_stiffness(const PairLaw& law, double radius) {
  return 4.0 / 3 * law.normal_modulus * std::sqrt(radius);
}

double critical_share(double zeta, double stiffness, double inertia) {
  return 2 * std::sqrt(5.0 / 6) * zeta * std::sqrt(stiffness * inertia);
}

}  // namespace

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

double normal_force(const PairLaw& law, const Normal& c, double sub_step) {
  const double k = hertz_stiffness(law, c.radius);
  const double elastic = c.overlap > 0 ? k * c.overlap * std::sqrt(c.overlap) : 0;
  const double damping = std::sqrt(5 * c.mass * k) * law.damping_ratio;
  const double half = 0.5 * sub_step * c.rate;
  const double mean_rate =
      0.8 * (five_quarters(c.overlap + half) - five_quarters(c.overlap - half)) / sub_step;
  return std::max(0.0, elastic + damping * mean_rate);
}

Vec3 stick_slip(double stiffness, double damping, double limit, const Vec3& rate, Vec3& stretch) {
  const Vec3 trial = -stiffness * stretch - damping * rate;
  const double size = trial.norm();
  if (size <= limit) return trial;
  const Vec3 slipping = limit / size * trial;
  stretch = (-1 / stiffness) * (slipping + damping * rate);
  return slipping;
}

Spring tangential_spring(const PairLaw& law, const Normal& c) {
  const double stiffness = 8 * law.shear_modulus * std::sqrt(c.radius * c.overlap);
  return {stiffness, critical_share(law.damping_ratio, stiffness, c.mass)};
}

Spring rolling_spring(const PairLaw& law, const Normal& c, const Spring& tangential, double inertia) {
  const double stiffness = tangential.stiffness * c.radius * c.radius;
  return {stiffness, critical_share(law.damping_ratio, stiffness, inertia)};
}

}  // namespace fpi::dem
