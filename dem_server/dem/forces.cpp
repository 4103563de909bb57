#include "dem/forces.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::dem {
namespace {

/// One touching pair: arms from the centres to the contact. Two bodies share the overlap, so that their
/// angular momentum is kept exactly; a wall takes the whole radius, so that rolling is v = ωR however soft
/// the contact.
struct Contact {
  Pair pair;
  Vec3 normal;
  bool wall;
  double arm_a, arm_b;  ///< [m]

  Contact(const Model& model, const Pair& p, const Separation& s)
      : pair(p),
        normal(s.normal),
        wall(p.b >= model.bodies.size()),
        arm_a(model.bodies.radius[p.a] + (wall ? 0 : 0.5 * s.gap)),
        arm_b(wall ? 0 : model.bodies.radius[p.b] + 0.5 * s.gap) {}

  /// Velocity of a's surface over b's, along the surface [m/s].
  Vec3 sliding(const std::vector<Vec3>& velocity, const std::vector<Vec3>& spin) const {
    Vec3 v = velocity[pair.a], w = arm_a * spin[pair.a];
    if (!wall) {
      v -= velocity[pair.b];
      w += arm_b * spin[pair.b];
    }
    return along(v) + w.cross(normal);
  }
  /// Spin of a over b without the twist about the normal [rad/s].
  Vec3 rolling(const std::vector<Vec3>& spin) const {
    return along(wall ? spin[pair.a] : Vec3(spin[pair.a] - spin[pair.b]));
  }
  Vec3 along(const Vec3& v) const { return v - v.dot(normal) * normal; }

  /// `force` on a and its opposite on b: pressed along the normal it has no moment, dragged along the surface
  /// it has.
  void press(const Vec3& force, Forces& forces) const {
    forces.force[pair.a] += force;
    if (!wall) forces.force[pair.b] -= force;
  }
  void drag(const Vec3& force, Forces& forces) const {
    press(force, forces);
    const Vec3 moment = normal.cross(force);
    forces.torque[pair.a] += arm_a * moment;
    if (!wall) forces.torque[pair.b] += arm_b * moment;
  }
  void twist(const Vec3& moment, Forces& forces) const {
    forces.torque[pair.a] += moment;
    if (!wall) forces.torque[pair.b] -= moment;
  }
};

/// Turns a spring into the contact's plane as it is now, without changing its length, and stretches it.
void follow(const Contact& contact, const Vec3& stretched, Vec3& spring) {
  const double length = spring.norm();
  if (length > 0) {
    spring = contact.along(spring);
    const double left = spring.norm();
    if (left > 0) spring *= length / left;
  }
  spring += stretched;
}

double pair_inertia(const Bodies& bodies, const Contact& contact) {
  const double b = contact.wall ? 0 : bodies.inverse_inertia[contact.pair.b];
  return 1 / (bodies.inverse_inertia[contact.pair.a] + b);
}

void add_friction(const Model& model, const Contact& contact, const PairLaw& law, const Normal& state,
                  double N, const Velocities& velocities, double stretch_time, Memory& memory,
                  Forces& forces) {
  const Spring tangential = tangential_spring(law, state);
  if (law.friction > 0) {
    follow(contact, stretch_time * contact.sliding(velocities.middle, velocities.middle_spin), memory.slip);
    const Vec3 rate = contact.sliding(velocities.now, velocities.now_spin);
    contact.drag(stick_slip(tangential, law.friction * N, rate, memory.slip), forces);
  }
  if (law.rolling_friction > 0) {
    const Spring spring = rolling_spring(law, state, tangential, pair_inertia(model.bodies, contact));
    follow(contact, stretch_time * contact.rolling(velocities.middle_spin), memory.roll);
    const double limit = law.rolling_friction * state.radius * N;
    const Vec3 rate = contact.rolling(velocities.now_spin);
    contact.twist(stick_slip(spring, limit, rate, memory.roll), forces);
  }
}

/// The gap [m] that no pair closes within half a sub-step: damping acts from the half in which the surfaces
/// meet.
double half_step_approach(const std::vector<Vec3>& velocity, double sub_step) {
  double fastest_squared = 0;
  for (const Vec3& v : velocity) fastest_squared = std::max(fastest_squared, v.squaredNorm());
  return sub_step * std::sqrt(fastest_squared);
}

double smaller_radius(const Bodies& bodies, const Pair& pair) {
  const double R = bodies.radius[pair.a];
  return pair.b < bodies.size() ? std::min(R, bodies.radius[pair.b]) : R;
}

}  // namespace

const PairLaw& law_of(const Model& model, const Pair& pair) {
  const std::size_t n = model.bodies.size();
  const std::size_t other = pair.b < n ? model.bodies.material[pair.b] : model.walls[pair.b - n].material;
  return model.laws(model.bodies.material[pair.a], other);
}

Normal normal_state(const Model& model, const Pair& pair, const Separation& gap,
                    const std::vector<Vec3>& velocity) {
  const Bodies& bodies = model.bodies;
  const double Ra = bodies.radius[pair.a];
  if (pair.b >= bodies.size()) return {bodies.mass[pair.a], Ra, -gap.gap, velocity[pair.a].dot(gap.normal)};
  const double Rb = bodies.radius[pair.b];
  return {1 / (bodies.inverse_mass[pair.a] + bodies.inverse_mass[pair.b]), Ra * Rb / (Ra + Rb), -gap.gap,
          (velocity[pair.a] - velocity[pair.b]).dot(gap.normal)};
}

ContactCount add_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                          double stretch_time, double sub_step, Neighbours& neighbours, Forces& forces) {
  ContactCount count;
  const double reach = half_step_approach(velocities.now, sub_step);
  for (std::size_t p = 0; p < neighbours.pairs.size(); ++p) {
    const Pair& pair = neighbours.pairs[p];
    Memory& memory = neighbours.memories[p];
    const Separation gap = separation(model, position, pair);
    if (gap.gap > reach) {
      if (!memory.empty()) memory = Memory{};
      continue;
    }
    const Contact contact(model, pair, gap);
    const PairLaw& law = law_of(model, pair);
    const Normal state = normal_state(model, pair, gap, velocities.now);
    const double N = normal_force(law, state, sub_step);
    contact.press(-N * gap.normal, forces);
    if (state.overlap > 0) {
      ++count.touching;
      count.largest_overlap = std::max(count.largest_overlap, state.overlap);
      if (state.overlap >= smaller_radius(model.bodies, pair)) count.too_deep = pair;
    }
    if (state.overlap > 0 && N > 0) {
      add_friction(model, contact, law, state, N, velocities, stretch_time, memory, forces);
    } else {
      memory = Memory{};
    }
  }
  return count;
}

}  // namespace fpi::dem
