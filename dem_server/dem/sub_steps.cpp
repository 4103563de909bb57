#include "dem/sub_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/attraction.hpp"

namespace fpi::dem {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// How fast a gap may close, and how fast that may grow.
struct Approach {
  double speed;         ///< [m/s]
  double acceleration;  ///< [m/s²]
};

/// Along the normal while that bounds the gap; else, at a round wall or one that turns, as if all motion in
/// the frame of the wall went into it.
Approach approach(const Near& near, const Vec3& velocity, const Vec3& acceleration) {
  if (near.frame.straight) return {velocity.dot(near.at.normal), acceleration.dot(near.at.normal)};
  return {velocity.norm(), acceleration.norm() + near.frame.acceleration};
}

/// v_a − v_b, or v_a in the frame of the wall [m/s].
Vec3 relative(const std::vector<Vec3>& v, const Near& near) {
  return v[near.a] - (near.wall() ? near.frame.velocity : v[near.b]);
}

/// Sub-step of two surfaces that meet with `speed` [m/s]; damping above ζ = 1 is stiffer than the spring.
double contact_step(const Model& model, const PairLaw& law, Normal state, double speed) {
  state.rate = speed;
  const double t_c = contact_time(model.elasticity, law, state);
  return t_c / (model.steps_per_contact * std::max(1.0, law.damping_ratio));
}

/// Sub-step that resolves the steepest attraction of two surfaces.
double attraction_step(const Model& model, const Near& near, double mass) {
  return std::numbers::pi * std::sqrt(mass / attraction_stiffness(model, near)) / model.steps_per_contact;
}

}  // namespace

Vec3 relative_acceleration(const Model& model, const Forces& loads, const Near& near) {
  const auto& w = model.bodies.inverse_mass;
  const Vec3 a = w[near.a] * loads.force[near.a];
  return near.wall() ? a : Vec3(a - w[near.b] * loads.force[near.b]);
}

double time_to_close(double gap, double closing, double acceleration) {
  if (gap <= 0) return 0;
  const double discriminant = closing * closing + 2 * acceleration * gap;
  if (discriminant < 0) return never;
  if (closing > 0) return 2 * gap / (closing + std::sqrt(discriminant));
  return acceleration > 0 ? (std::sqrt(discriminant) - closing) / acceleration : never;
}

Outlook look_ahead(const Model& model, const State& state, const Forces& loads, double horizon) {
  Outlook outlook{never, never};
  const auto& velocity = state.motions.velocity;
  each_near(model, state, [&](const Near& near) {
    const Normal normal = normal_state(model, near, velocity);
    const Vec3 acceleration = relative_acceleration(model, loads, near);
    const Vec3 meets_with = relative(velocity, near);
    const Approach closing = approach(near, meets_with, acceleration);
    const double reach = std::max(attraction_reach(model, near), 0.0);
    const double meeting = time_to_close(near.at.gap - reach, closing.speed, closing.acceleration);
    if (std::isinf(meeting)) return;
    const double speed = meets_with.norm() + acceleration.norm() * horizon;
    double step = contact_step(model, near.law, normal, speed);
    if (reach > 0) step = std::min(step, attraction_step(model, near, normal.mass));
    if (meeting >= horizon + step) return;
    outlook.free_time = std::min(outlook.free_time, meeting);
    outlook.contact_step = std::min(outlook.contact_step, step);
  });
  return outlook;
}

double time_within_skin(const Model& model, const State& state, const Forces& loads) {
  const auto& [motions, neighbours, walls] = state;
  if (std::isinf(neighbours.skin)) return never;
  double time = walls.speed > 0 ? std::max(0.0, 0.5 * neighbours.skin - walls.moved) / walls.speed : never;
  for (std::size_t i = 0; i < motions.position.size(); ++i) {
    const double left = 0.5 * neighbours.skin - (motions.position[i] - neighbours.origin[i]).norm();
    const double acceleration = model.bodies.inverse_mass[i] * loads.force[i].norm();
    time = std::min(time, time_to_close(left, motions.velocity[i].norm(), acceleration));
  }
  return time;
}

}  // namespace fpi::dem
