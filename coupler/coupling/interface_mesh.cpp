#include "coupling/interface_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace fpi::coupling {
namespace {

constexpr double most_arcs = 1e6;  ///< of one body; a length that asks for more is a mistake

/// Gauss–Legendre points on [0, 1]: ½ and ½ ± √(3/20).
constexpr std::array<double, points_per_arc> legendre{0.11270166537925831, 0.5, 0.88729833462074169};

Eigen::Vector2d point(const std::vector<double>& coordinates, std::size_t i) {
  const std::size_t k = 2 * i % coordinates.size();
  return {coordinates[k], coordinates[k + 1]};
}

}  // namespace

Arcs cut_circle(const Eigen::Vector3d& centre, double radius, double wanted_length) {
  const double around = 2 * std::numbers::pi * radius;
  require(
      radius > 0 && wanted_length > 0 && around / wanted_length < most_arcs,
      "a radius > 0 m and an arc length > 0 m that cuts the circle into fewer than {} arcs are required; got "
      "radius {} and length {}: see what the fluid asks for",
      most_arcs, radius, wanted_length);
  const auto n = static_cast<std::size_t>(std::max(3L, std::lround(around / wanted_length)));
  Arcs arcs{.centre = centre, .radius = radius, .start = {}, .end = {}, .vertices = {}};
  const auto angle = [n](std::size_t i) {
    return 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
  };
  for (std::size_t a = 0; a < n; ++a) {
    arcs.start.push_back(angle(a));
    arcs.end.push_back(angle(a + 1));
  }
  return arcs;
}

Arcs cut_polygon(const Eigen::Vector3d& centre, const Eigen::Quaterniond& orientation,
                 const std::vector<double>& corners, double wanted_length) {
  const Eigen::Matrix2d turn = orientation.toRotationMatrix().topLeftCorner<2, 2>();
  Arcs arcs{.centre = centre, .radius = 0, .start = {}, .end = {}, .vertices = {}};
  for (std::size_t k = 0; k < corners.size() / 2; ++k) {
    const Eigen::Vector2d from = centre.head<2>() + turn * point(corners, k);
    const Eigen::Vector2d along = turn * (point(corners, k + 1) - point(corners, k));
    require(
        wanted_length > 0 && along.norm() / wanted_length < most_arcs,
        "an edge length > 0 m that cuts each side into fewer than {} edges is required; got {} for a side "
        "of {} m: see what the fluid asks for",
        most_arcs, wanted_length, along.norm());
    const auto n = std::max(1L, std::lround(along.norm() / wanted_length));
    for (long e = 0; e < n; ++e) {
      const Eigen::Vector2d x = from + static_cast<double>(e) / static_cast<double>(n) * along;
      arcs.vertices.insert(arcs.vertices.end(), {x.x(), x.y()});
    }
  }
  return arcs;
}

Arcs cut_surface(const scene::Body& body, const RigidMotion& motion, double hydraulic_radius_ratio,
                 double wanted_length) {
  if (body.shape == "polygon")
    return cut_polygon(motion.position, motion.orientation, body.surface(), wanted_length);
  return cut_circle(motion.position, hydraulic_radius_ratio * body.radius, wanted_length);
}

Eigen::Vector2d Arcs::from_centre(std::size_t a, double s) const {
  if (radius == 0) return (1 - s) * point(vertices, a) + s * point(vertices, a + 1) - centre.head<2>();
  const double angle = start[a] + s * (end[a] - start[a]);
  return radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

std::vector<double> velocities_on(const Arcs& arcs, const RigidMotion& motion) {
  std::vector<double> velocities;
  velocities.reserve(2 * points_per_arc * arcs.size());
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    for (const double place : legendre) {
      const Eigen::Vector2d arm = arcs.from_centre(a, place);
      velocities.push_back(motion.velocity.x() - motion.spin.z() * arm.y());
      velocities.push_back(motion.velocity.y() + motion.spin.z() * arm.x());
    }
  }
  return velocities;
}

}  // namespace fpi::coupling
