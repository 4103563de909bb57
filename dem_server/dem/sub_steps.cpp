#include "dem/sub_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fpi::dem {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// v_a − v_b of a vector that bodies have, v_a at a wall.
Vec3 relative(const std::vector<Vec3>& v, const Pair& pair) {
  return pair.b < v.size() ? Vec3(v[pair.a] - v[pair.b]) : v[pair.a];
}

/// Sub-step of a pair that meets with `speed` [m/s]; damping above ζ = 1 is stiffer than the spring.
double contact_step(const Model& model, const Pair& pair, Normal state, double speed) {
  const PairLaw& law = law_of(model, pair);
  state.rate = speed;
  const double t_c = contact_time(state.mass, state.radius, law.normal_modulus, equivalent_speed(law, state));
  return t_c / (model.steps_per_contact * std::max(1.0, law.damping_ratio));
}

}  // namespace

Vec3 relative_acceleration(const Model& model, const Forces& loads, const Pair& pair) {
  const auto& w = model.bodies.inverse_mass;
  const Vec3 a = w[pair.a] * loads.force[pair.a];
  return pair.b < model.bodies.size() ? Vec3(a - w[pair.b] * loads.force[pair.b]) : a;
}

double time_to_close(double gap, double closing, double acceleration) {
  if (gap <= 0) return 0;
  const double discriminant = closing * closing + 2 * acceleration * gap;
  if (discriminant < 0) return never;
  if (closing > 0) return 2 * gap / (closing + std::sqrt(discriminant));
  return acceleration > 0 ? (std::sqrt(discriminant) - closing) / acceleration : never;
}

Outlook look_ahead(const Model& model, const Motions& motions, const Forces& loads,
                   const Neighbours& neighbours, double horizon) {
  Outlook outlook{never, never};
  for (const Pair& pair : neighbours.pairs) {
    const Separation gap = separation(model, motions.position, pair);
    const Normal state = normal_state(model, pair, gap, motions.velocity);
    const Vec3 acceleration = relative_acceleration(model, loads, pair);
    const double meeting = time_to_close(gap.gap, state.rate, acceleration.dot(gap.normal));
    if (std::isinf(meeting)) continue;
    const double speed = relative(motions.velocity, pair).norm() + acceleration.norm() * horizon;
    const double step = contact_step(model, pair, state, speed);
    if (meeting >= horizon + step) continue;
    outlook.free_time = std::min(outlook.free_time, meeting);
    outlook.contact_step = std::min(outlook.contact_step, step);
  }
  return outlook;
}

double time_within_skin(const Model& model, const Motions& motions, const Forces& loads,
                        const Neighbours& neighbours) {
  if (std::isinf(neighbours.skin)) return never;
  double time = never;
  for (std::size_t i = 0; i < motions.position.size(); ++i) {
    const double left = 0.5 * neighbours.skin - (motions.position[i] - neighbours.origin[i]).norm();
    const double acceleration = model.bodies.inverse_mass[i] * loads.force[i].norm();
    time = std::min(time, time_to_close(left, motions.velocity[i].norm(), acceleration));
  }
  return time;
}

}  // namespace fpi::dem
