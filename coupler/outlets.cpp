#include "outlets.hpp"

#include <algorithm>

namespace fpi {
namespace {

/// Whether the box contains the interval of the body along every axis, made `wider` on both sides [m].
bool contains(const scene::Outlet& outlet, const Eigen::Vector3d& centre, double wider) {
  for (std::size_t axis = 0; axis < outlet.lower.size(); ++axis) {
    const double x = centre[static_cast<Eigen::Index>(axis)];
    if (x - wider < outlet.lower[axis] || x + wider > outlet.upper[axis]) return false;
  }
  return true;
}

}  // namespace

std::vector<Departure> departures(const scene::Scene& scene, const CoupledState& state) {
  std::vector<Departure> found;
  for (std::size_t i = 0; i < scene.bodies.size() && !scene.outlets.empty(); ++i) {
    const scene::Body& body = scene.bodies[i];
    if (!body.is_free() || !state.is_there(i)) continue;
    const Eigen::Vector3d place = scene.periodic.inside(state.motions[i].position);
    const auto outlet = std::ranges::find_if(
        scene.outlets, [&](const scene::Outlet& o) { return contains(o, place, body.radius); });
    if (outlet == scene.outlets.end()) continue;
    found.push_back({.body = i,
                     .outlet = static_cast<std::size_t>(outlet - scene.outlets.begin()),
                     .motion = state.motions[i],
                     .mass = body.density * body.volume(body.radius, scene.thickness)});
  }
  return found;
}

bool is_at_outlet(const scene::Scene& scene, const scene::Body& body, const Eigen::Vector3d& position) {
  const Eigen::Vector3d place = scene.periodic.inside(position);
  return std::ranges::any_of(scene.outlets,
                             [&](const scene::Outlet& o) { return contains(o, place, -body.radius); });
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
