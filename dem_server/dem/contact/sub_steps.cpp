#include "dem/contact/sub_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/contact/attraction.hpp"

namespace fpi::dem {
namespace {

/// Sub-steps in the contact time of two surfaces: damping above ζ = 1 is stiffer than the spring.
double steps_per_contact(const Model& model, const PairLaw& law) {
  return model.steps_per_contact * std::max(1.0, law.damping_ratio);
}

/// Along the normal while that bounds the gap; else, at a round wall or one that turns, as if all motion in
/// the frame of the wall went into it.
Approach approach(const Near& near, const Vec3& velocity, const Vec3& acceleration) {
  if (near.frame.straight) return {velocity.dot(near.at.normal), acceleration.dot(near.at.normal)};
  return {velocity.norm(), acceleration.norm() + near.frame.acceleration};
}

/// Where an attraction begins, and the sub-step that resolves the steepest of it.
Pull pull_of(const Model& model, const Near& near, double mass) {
  const double reach = attraction_reach(model, near);
  if (reach <= 0) return {};
  const double stiffness = attraction_stiffness(model, near);
  return {reach, std::numbers::pi * std::sqrt(mass / stiffness) / model.steps_per_contact};
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

void StepEstimate::consider(const Model& model, const PairLaw& law, const Normal& normal,
                            const Approach& closing, double speed, const Pull& pull) {
  free_time =
      std::min(free_time, time_to_close(-normal.overlap - pull.reach, closing.speed, closing.acceleration));
  if (4 * speed * contact_step > normal.radius) contact_step = normal.radius / (4 * speed);
  const double steps = steps_per_contact(model, law);
  Normal met = normal;
  met.rate = speed;
  if (pull.step >= contact_step && lasts_longer(model.elasticity, law, met, steps * contact_step)) return;
  contact_step = std::min({contact_step, contact_time(model.elasticity, law, met) / steps, pull.step});
}

double sub_step_length(double longest, double now, double left, bool iterates) {
  if (now > 0 && now <= (iterates ? 2 : 1.01) * longest && now >= (iterates ? 0.25 : 0.8) * longest)
    return now;
  return iterates || longest >= left ? longest : left / std::ceil(left / longest - 0.01);
}

double whole_sub_steps(double time, double length, double left) {
  const bool has_length = length > 0 && std::isfinite(length);
  return time < left && has_length ? length * std::floor(time / length)
                                   : std::min(left, time);  // left where time is ∞ − ∞
}

void look_ahead_pairs(const Model& model, const Neighbours& neighbours, const Particles& particles,
                      const std::vector<Vec3>& position, StepEstimate& estimate) {
  const bool attracts = widest_attraction(model) > 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (std::uint32_t p = neighbours.start[i]; p < neighbours.start[i + 1]; ++p) {
      const std::size_t j = neighbours.other[p];
      const Record &place_i = particles.place[i], &place_j = particles.place[j];
      const Vec3 line = model.periodic.shortest(Vec3((place_j - place_i).head<3>()));
      const Vec3 velocity = (particles.half[i].linear - particles.half[j].linear).head<3>();
      const Vec3 acceleration = (particles.acceleration(i) - particles.acceleration(j)).head<3>();
      const double distance = line.norm(), Ri = place_i[3], Rj = place_j[3];
      const Approach closing{velocity.dot(line) / distance, acceleration.dot(line) / distance};
      const Normal normal{1 / (particles.half[i].linear[3] + particles.half[j].linear[3]),
                          Ri * Rj / (Ri + Rj), Ri + Rj - distance, closing.speed};
      const Pair pair{particles.body[i], particles.body[j]};
      estimate.consider(model, model.laws(particles.material[i], particles.material[j]), normal, closing,
                        velocity.norm() + acceleration.norm() * estimate.horizon,
                        attracts ? pull_of(model, near(model, position, pair), normal.mass) : Pull{});
    }
  }
}

void look_ahead_walls(const Model& model, const State& state, const Forces& loads, StepEstimate& estimate) {
  const Motions& motions = state.motions;
  const WallContacts& wall_contacts = state.wall_contacts;
  for (const WallPlace& place : wall_contacts.places) {
    const Near here = near(model, motions.position, wall_contacts.motions, place);
    const Vec3 velocity = motions.velocity[here.a] - here.frame.velocity;
    const Vec3 acceleration = relative_acceleration(model, loads, here);
    const Normal normal = normal_state(model, here, motions.velocity);
    estimate.consider(model, here.law, normal, approach(here, velocity, acceleration),
                      velocity.norm() + acceleration.norm() * estimate.horizon,
                      pull_of(model, here, normal.mass));
  }
}

double time_within_skin(const Neighbours& neighbours, const WallContacts& walls, const Particles& particles) {
  if (std::isinf(neighbours.skin)) return never;
  double time = walls.speed > 0 ? std::max(0.0, 0.5 * neighbours.skin - walls.moved) / walls.speed : never;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double left = 0.5 * neighbours.skin - (particles.place[i].head<3>() - neighbours.origin[i]).norm();
    time = std::min(time, time_to_close(left, particles.half[i].linear.head<3>().norm(),
                                        particles.acceleration(i).norm()));
  }
  return time;
}

double time_of_quarter_skin(const Neighbours& neighbours, const WallContacts& walls,
                            const Particles& particles) {
  if (std::isinf(neighbours.skin)) return never;
  const double way = 0.25 * neighbours.skin;
  double time = walls.speed > 0 ? way / walls.speed : never;
  for (std::size_t i = 0; i < particles.size(); ++i)
    time = std::min(time, time_to_close(way, particles.half[i].linear.head<3>().norm(),
                                        particles.acceleration(i).norm()));
  return time;
}

double farthest_moved(const Neighbours& neighbours, const Particles& particles) {
  double farthest_squared = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double moved = (particles.place[i].head<3>() - neighbours.origin[i]).squaredNorm();
    // Written so that a position that is not a number counts as moved.
    if (!(moved <= farthest_squared)) farthest_squared = moved;
  }
  return std::sqrt(farthest_squared);
}

}  // namespace fpi::dem
