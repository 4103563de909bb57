#include "coupling/interface_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace fpi::coupling {
namespace {

constexpr double most_arcs = 1e6;  ///< of one body; a length that asks for more is a mistake

/// Gauss–Legendre points on [−1, 1]: 0 and ±√(3/5).
constexpr std::array<double, points_per_arc> legendre{-0.77459666924148338, 0, 0.77459666924148338};

}  // namespace

Arcs cut_circle(const Eigen::Vector3d& centre, double radius, double wanted_length) {
  const double around = 2 * std::numbers::pi * radius;
  require(
      radius > 0 && wanted_length > 0 && around / wanted_length < most_arcs,
      "a radius > 0 m and an arc length > 0 m that cuts the circle into fewer than {} arcs are required; got "
      "radius {} and length {}: see what the fluid asks for",
      most_arcs, radius, wanted_length);
  const auto n = static_cast<std::size_t>(std::max(3L, std::lround(around / wanted_length)));
  Arcs arcs{.centre = centre, .radius = radius, .start = {}, .end = {}};
  const auto angle = [n](std::size_t i) {
    return 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
  };
  for (std::size_t a = 0; a < n; ++a) {
    arcs.start.push_back(angle(a));
    arcs.end.push_back(angle(a + 1));
  }
  return arcs;
}

std::vector<double> velocities_on(const Arcs& arcs, const RigidMotion& motion) {
  std::vector<double> velocities;
  velocities.reserve(2 * points_per_arc * arcs.size());
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    const double middle = 0.5 * (arcs.start[a] + arcs.end[a]), half = 0.5 * (arcs.end[a] - arcs.start[a]);
    for (const double place : legendre) {
      const double angle = middle + half * place;
      velocities.push_back(motion.velocity.x() - motion.spin.z() * arcs.radius * std::sin(angle));
      velocities.push_back(motion.velocity.y() + motion.spin.z() * arcs.radius * std::cos(angle));
    }
  }
  return velocities;
}

}  // namespace fpi::coupling
