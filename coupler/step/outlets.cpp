#include "step/outlets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fpi {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Straight, of a centre, from share 0 to share 1 [m].
struct Way {
  Eigen::Vector3d from, to;
};

/// Where a centre may be along an axis, and after what length that is so again; 0: never.
struct Interval {
  double lower, upper, period;  ///< [m]
};

/// For a body that is to be inside by `margin` [m] on both sides. Along a periodic axis an outlet as long as
/// the box has no ends.
Interval interval(const scene::Scene& scene, const scene::Outlet& outlet, std::size_t axis, double margin) {
  const std::vector<double>& planes = scene.periodic.along(static_cast<int>(axis));
  const double lower = outlet.lower[axis], upper = outlet.upper[axis];
  if (planes.empty()) return {lower + margin, upper - margin, 0};
  const double period = planes[1] - planes[0];
  if (upper - lower >= period) return {-never, never, 0};
  return {lower + margin, upper - margin, period};
}

/// First share of the way, from `first` to `last`, at which it is in the outlet along this axis and all after
/// it.
double first_inside(const scene::Scene& scene, const scene::Outlet& outlet, const Way& way, double margin,
                    std::size_t axis, double first, double last) {
  if (axis == outlet.lower.size()) return first;
  const auto [lower, upper, period] = interval(scene, outlet, axis, margin);
  const auto a = way.from[static_cast<Eigen::Index>(axis)], b = way.to[static_cast<Eigen::Index>(axis)];
  const double nearest = period > 0 ? std::ceil((std::min(a, b) - upper) / period) : 0;
  const double farthest = period > 0 ? std::floor((std::max(a, b) - lower) / period) : 0;
  double found = never;
  for (double image = nearest; image <= farthest && lower <= upper; ++image) {
    const double low = lower + image * period, high = upper + image * period;
    double enters = first, leaves = last;
    if (a == b) {
      if (a < low || a > high) continue;
    } else {
      enters = std::max(first, std::min((low - a) / (b - a), (high - a) / (b - a)));
      leaves = std::min(last, std::max((low - a) / (b - a), (high - a) / (b - a)));
    }
    if (enters <= leaves)
      found = std::min(found, first_inside(scene, outlet, way, margin, axis + 1, enters, leaves));
  }
  return found;
}

double first_inside(const scene::Scene& scene, const scene::Outlet& outlet, const Way& way, double margin) {
  return first_inside(scene, outlet, way, margin, 0, 0, 1);
}

/// The first outlet on the way of a body; the number of outlets if there is none.
std::size_t outlet_on(const scene::Scene& scene, const Way& way, double radius) {
  std::size_t found = scene.outlets.size();
  double first = never;
  for (std::size_t o = 0; o < scene.outlets.size(); ++o) {
    const double share = first_inside(scene, scene.outlets[o], way, radius);
    if (share < first) {
      first = share;
      found = o;
    }
  }
  return found;
}

}  // namespace

std::vector<Departure> departures(const scene::Scene& scene, const CoupledState& state,
                                  std::span<const coupling::RigidMotion> before) {
  std::vector<Departure> found;
  for (std::size_t i = 0; i < scene.bodies.size() && !scene.outlets.empty(); ++i) {
    const scene::Body& body = scene.bodies[i];
    if (!body.is_free() || !state.is_there(i)) continue;
    const Eigen::Vector3d& now = state.motions[i].position;
    const std::size_t outlet =
        outlet_on(scene, {before.empty() ? now : before[i].position, now}, body.radius);
    if (outlet == scene.outlets.size()) continue;
    found.push_back({.body = i,
                     .outlet = outlet,
                     .motion = state.motions[i],
                     .mass = body.density * body.volume(body.radius, scene.thickness)});
  }
  return found;
}

bool is_at_outlet(const scene::Scene& scene, const scene::Body& body, const Eigen::Vector3d& position) {
  return std::ranges::any_of(scene.outlets, [&](const scene::Outlet& outlet) {
    return first_inside(scene, outlet, {position, position}, -body.radius) < never;
  });
}

void take_out(const std::vector<Departure>& departures, CoupledState& state) {
  for (const Departure& departure : departures) {
    Departed& sum = state.departed[departure.outlet];
    ++sum.count;
    sum.mass += departure.mass;
    sum.momentum += departure.mass * departure.motion.velocity;
    state.left[departure.body] = true;
    state.motions[departure.body].velocity.setZero();
    state.motions[departure.body].spin.setZero();
    state.loads[departure.body] = {};
  }
}

}  // namespace fpi
