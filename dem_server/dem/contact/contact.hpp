/// One place where a body touches a wall: how the surfaces move over each other, and the forces and moments
/// that come of it. Pairs of bodies are taken several at once, by pair_forces.hpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "dem/base/loads.hpp"
#include "dem/neighbours/neighbours.hpp"

namespace fpi::dem {

/// The forces of one contact as they act on body a; b, or the wall, gets the opposite.
struct ContactForce {
  std::uint32_t a = 0, b = no_body;
  Vec3 normal = Vec3::Zero();                                   ///< from a towards the other
  double elastic = 0, damping = 0;                              ///< [N] along it, > 0 parts them
  Vec3 friction = Vec3::Zero();                                 ///< [N]
  Vec3 resistance = Vec3::Zero();                               ///< [N m] to rolling and twisting
  double arm_a = 0, arm_b = 0;                                  ///< [m] of the friction; −arm_a at a wall
  Vec3 wall_velocity = Vec3::Zero(), wall_spin = Vec3::Zero();  ///< of a wall's frame at the centre of a
};

/// What an evaluation of the contacts met.
struct ContactCount {
  std::uint64_t touching = 0;
  double largest_overlap = 0;   ///< [m]
  std::string too_deep{};       ///< "a and b" that overlap by a radius or more: what comes then is no contact
  std::uint32_t deep_body = 0;  ///< the one that moves

  std::vector<ContactForce> forces{};  ///< of each, where the scene accounts for energy

  void add(const ContactCount& other) {
    forces.insert(forces.end(), other.forces.begin(), other.forces.end());
    touching += other.touching;
    largest_overlap = std::max(largest_overlap, other.largest_overlap);
    if (!other.too_deep.empty()) note_too_deep(other.too_deep, other.deep_body);
  }
  void note_too_deep(std::string names, std::uint32_t body) {
    too_deep = std::move(names);
    deep_body = body;
  }
};

/// Velocities that the contacts see: at the middle of the last sub-step for what their springs have stretched
/// by, and extrapolated to now for what their dashpots feel.
struct Velocities {
  const std::vector<Vec3>& middle;       ///< [m/s]
  const std::vector<Vec3>& middle_spin;  ///< [rad/s]
  const std::vector<Vec3>& now;
  const std::vector<Vec3>& now_spin;
};

/// The sub-step that contacts are evaluated at the end of.
struct SubStep {
  double stretch_time;  ///< [s] that springs have stretched for at the middle velocities
  double duration;      ///< [s] that the normal damping is averaged over
  double reach;         ///< [m] the gap that nothing closes within half of it: damping acts from the half in
                        ///< which the surfaces meet
};

/// Effective mass m* and radius R* of two surfaces, with their overlap and the rate at which it grows with
/// `velocity`.
Normal normal_state(const Model& model, const Near& near, const std::vector<Vec3>& velocity);

/// Adds the force and moments of a place at a wall to `forces`, by the law Hertz or Linear, and to those that
/// `count` records. True where it touches.
template <class Elastic>
bool add_contact(const Model& model, const Near& near, const Velocities& velocities, const SubStep& sub_step,
                 ContactHistory& history, Forces& forces, ContactCount& count);

/// Whether the centre of a body is behind a wall or has come through it in this sub-step: from there on a
/// wall with grains on either side would push it on, away from where it came. A sub-step leads less than a
/// radius.
inline bool is_behind(const Model& model, const Near& here, const Velocities& velocities, double sub_step) {
  const double distance = here.at.gap + model.bodies.radius[here.a];
  if (distance > 0.5 * model.bodies.radius[here.a]) return false;
  const double rate = (velocities.middle[here.a] - here.frame.velocity).dot(here.at.normal);
  return distance + std::min(sub_step * rate, 0.0) <= 0;
}

/// Adds such a place and counts it where it touches; names(model, place) says whose surfaces they are.
template <class Elastic, class Place>
void add_place(const Model& model, const Near& here, const Place& place, const Velocities& velocities,
               const SubStep& sub_step, ContactHistory& history, Forces& forces, ContactCount& count) {
  if (!add_contact<Elastic>(model, here, velocities, sub_step, history, forces, count)) return;
  const double overlap = -here.at.gap;
  ++count.touching;
  count.largest_overlap = std::max(count.largest_overlap, overlap);
  if (is_behind(model, here, velocities, sub_step.stretch_time))
    count.note_too_deep(names(model, place), here.a);
}

}  // namespace fpi::dem
