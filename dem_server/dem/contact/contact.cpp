#include "dem/contact/contact.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::dem {
namespace {

/// A body at a wall. The arm to the contact is the whole radius, so that rolling is v = ωR however soft the
/// contact.
struct Contact {
  std::uint32_t a;
  Vec3 normal;
  double arm;  ///< [m]
  const WallFrame& frame;

  Contact(const Model& model, const Near& near)
      : a(near.a), normal(near.at.normal), arm(model.bodies.radius[a]), frame(near.frame) {}

  /// n × velocity of the body's surface over the wall's [m/s].
  Vec3 sliding(const std::vector<Vec3>& velocity, const std::vector<Vec3>& spin) const {
    return normal.cross(velocity[a] - frame.velocity) + arm * along(turning(spin));
  }
  /// Spin of the body over the wall [rad/s]: rolling along the surface, twisting along the normal.
  Vec3 turning(const std::vector<Vec3>& spin) const { return spin[a] - frame.spin; }
  Vec3 along(const Vec3& v) const { return v - v.dot(normal) * normal; }

  void press(const Vec3& force, Forces& forces) const { forces.force[a] += force; }
  /// n × `friction` on the body.
  void drag(const Vec3& friction, Forces& forces) const {
    press(friction.cross(normal), forces);
    forces.torque[a] += arm * friction;
  }
  void twist(const Vec3& moment, Forces& forces) const { forces.torque[a] += moment; }
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

/// What does not turn needs no dashpot.
double inertia(const Bodies& bodies, std::uint32_t body) {
  return bodies.inverse_inertia[body] > 0 ? 1 / bodies.inverse_inertia[body] : 0;
}

/// What acts along the surface of a contact, and against turning in it.
struct Traction {
  Vec3 friction = Vec3::Zero();    ///< n × friction on the body [N]
  Vec3 resistance = Vec3::Zero();  ///< [N m]
};

template <class Elastic>
Traction rub(const Model& model, const Contact& contact, const PairLaw& law, const Normal& state,
             double slope, double N, const Velocities& velocities, double stretch_time,
             ContactHistory& history) {
  Traction traction;
  const Spring tangential = tangential_spring<Elastic>(law, state, slope);
  if (law.friction > 0) {
    follow(contact, stretch_time * contact.sliding(velocities.middle, velocities.middle_spin), history.slip);
    const Vec3 rate = contact.sliding(velocities.now, velocities.now_spin);
    traction.friction = stick_slip(tangential, law.friction * N, rate, history.slip);
  }
  if (law.rolling_friction == 0 && law.twisting_friction == 0) return traction;
  const Spring turning = turning_spring(law, state, tangential, inertia(model.bodies, contact.a));
  const Vec3 middle = contact.turning(velocities.middle_spin), now = contact.turning(velocities.now_spin);
  if (law.rolling_friction > 0) {
    follow(contact, stretch_time * contact.along(middle), history.roll);
    const double limit = law.rolling_friction * state.radius * N;
    traction.resistance += stick_slip(turning, limit, contact.along(now), history.roll);
  }
  if (law.twisting_friction > 0) {
    history.twist += stretch_time * middle.dot(contact.normal);
    const double limit = law.twisting_friction * state.radius * N;
    traction.resistance +=
        stick_slip(turning, limit, now.dot(contact.normal), history.twist) * contact.normal;
  }
  return traction;
}

/// For the account of energies, of the normal force N.
template <class Elastic>
ContactForce recorded(const Near& near, const Contact& contact, const Normal& state, const Mean& mean,
                      double sub_step, double N) {
  const double elastic = elastic_force<Elastic>(near.law, state, mean, sub_step);
  return {.a = near.a,
          .normal = near.at.normal,
          .elastic = elastic,
          .damping = N - elastic,
          .arm_a = contact.arm,
          .arm_b = -contact.arm,
          .wall_velocity = near.frame.velocity,
          .wall_spin = near.frame.spin};
}

}  // namespace

Normal normal_state(const Model& model, const Near& near, const std::vector<Vec3>& velocity) {
  const Bodies& bodies = model.bodies;
  const auto& [normal, gap] = near.at;
  const double Ra = bodies.radius[near.a];
  if (near.wall())
    return {1 / bodies.inverse_mass[near.a], Ra, -gap, (velocity[near.a] - near.frame.velocity).dot(normal)};
  const double Rb = bodies.radius[near.b];
  return {1 / (bodies.inverse_mass[near.a] + bodies.inverse_mass[near.b]), Ra * Rb / (Ra + Rb), -gap,
          (velocity[near.a] - velocity[near.b]).dot(normal)};
}

template <class Elastic>
bool add_contact(const Model& model, const Near& near, const Velocities& velocities, const SubStep& sub_step,
                 ContactHistory& history, Forces& forces, ContactCount& count) {
  if (near.at.gap > sub_step.reach) {
    if (!history.empty()) history = ContactHistory{};
    return false;
  }
  const Contact contact(model, near);
  Normal state = normal_state(model, near, velocities.now);
  const double middle_rate = normal_state(model, near, velocities.middle).rate;  // half a sub-step ago
  const Mean mean = mean_over<Elastic>(state.overlap, sub_step.duration * state.rate);
  state.acceleration = acceleration_now<Elastic>(
      near.law, state, 2 * (state.rate - middle_rate) / sub_step.duration, sub_step.stretch_time);
  const double N = normal_force<Elastic>(near.law, state, mean, sub_step.duration);
  contact.press(-N * near.at.normal, forces);
  if (model.accounts_energy)
    count.forces.push_back(recorded<Elastic>(near, contact, state, mean, sub_step.duration, N));
  if (mean.overlap > 0 && N > 0) {
    const double stretched =
        sub_step.stretch_time * share_in_contact(state.overlap, sub_step.stretch_time * middle_rate);
    const auto [friction, resistance] =
        rub<Elastic>(model, contact, near.law, state, mean.slope, N, velocities, stretched, history);
    contact.drag(friction, forces);
    contact.twist(resistance, forces);
    if (model.accounts_energy) {
      count.forces.back().friction = friction.cross(near.at.normal);
      count.forces.back().resistance = resistance;
    }
  } else {
    history = ContactHistory{};
  }
  return state.overlap > 0;
}

template bool add_contact<Hertz>(const Model&, const Near&, const Velocities&, const SubStep&,
                                 ContactHistory&, Forces&, ContactCount&);
template bool add_contact<Linear>(const Model&, const Near&, const Velocities&, const SubStep&,
                                  ContactHistory&, Forces&, ContactCount&);

}  // namespace fpi::dem
