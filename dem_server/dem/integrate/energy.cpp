#include "dem/integrate/energy.hpp"

#include "dem/contact/attraction.hpp"

namespace fpi::dem {
namespace {

template <class Elastic>
double stored_along_normal(const Near& near, const Normal& state) {
  const double s = Elastic::amplitude(std::max(state.overlap, 0.0));
  return 0.5 * Elastic::stiffness(near.law.normal, state.radius) * s * s;
}

/// Springs are as stiff as the overlap makes them now.
template <class Elastic>
void add_springs(const Near& near, Normal state, const ContactHistory& history, Energies& sum) {
  state.overlap = std::max(state.overlap, 0.0);
  const Spring along =
      tangential_spring<Elastic>(near.law, state, Elastic::slope(std::max(state.overlap, 0.0)));
  const Spring turning = turning_spring(near.law, state, along, 0.0);
  sum.tangential += 0.5 * along.stiffness * history.slip.squaredNorm();
  sum.turning += 0.5 * turning.stiffness * (history.roll.squaredNorm() + history.twist * history.twist);
}

/// Calls visit(near, history) for the contacts that remember.
template <class Visit>
void each_remembered(const Model& model, const State& state, Visit visit) {
  const std::vector<Vec3>& position = state.motions.position;
  const ContactList<Pair>& pairs = state.contacts;
  for (std::size_t p = 0; p < pairs.places.size(); ++p)
    visit(near(model, position, pairs.places[p]), pairs.histories[p]);
  const WallContacts& walls = state.wall_contacts;
  for (std::size_t p = 0; p < walls.places.size(); ++p)
    if (!walls.histories[p].empty())
      visit(near(model, position, walls.motions, walls.places[p]), walls.histories[p]);
}

}  // namespace

double kinetic_energy(const Bodies& bodies, std::span<const Vec3> velocity, std::span<const Vec3> spin) {
  double sum = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies.is_free(i))
      sum +=
          0.5 * bodies.mass[i] * velocity[i].squaredNorm() + 0.5 * bodies.inertia[i] * spin[i].squaredNorm();
  return sum;
}

Energies energies(const Model& model, const State& state) {
  const Motions& motions = state.motions;
  Energies sum{.kinetic = kinetic_energy(model.bodies, motions.velocity, motions.spin)};
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (model.bodies.is_free(i))
      sum.potential -= model.bodies.mass[i] * model.gravity.dot(motions.position[i]);
  with_elastic_law(model.elasticity, [&](auto law) {
    using Elastic = decltype(law);
    each_acting(model, state, widest_attraction(model), [&](const Near& near) {
      sum.potential += attraction_energy(model, near);
      sum.normal += stored_along_normal<Elastic>(near, normal_state(model, near, motions.velocity));
    });
    each_remembered(model, state, [&](const Near& near, const ContactHistory& history) {
      add_springs<Elastic>(near, normal_state(model, near, motions.velocity), history, sum);
    });
  });
  return sum;
}

EnergyAccount energy_account(const Energies& start, const Energies& now, const State& state) {
  const Works& works = state.works;
  const auto gain = [&](double Energies::*of) { return now.*of + state.taken.*of - start.*of; };
  return {now.kinetic,
          now.potential,
          now.elastic(),
          -works.damping,
          -works.friction - gain(&Energies::tangential),
          -works.turning - gain(&Energies::turning),
          -works.films,
          state.taken.all(),
          works.loads,
          works.boundaries,
          works.conservative + gain(&Energies::potential) + gain(&Energies::normal)};
}

void WorkMeter::add_kick(double duration, const Particles& particles, std::span<const ContactForce> contacts,
                         Works& works) {
  add_bodies(duration, particles, works);
  for (const ContactForce& contact : contacts) add_contact(duration, contact, works);
}

/// What changes a body's own kinetic energy besides contacts and weight is the work of loads, the inertia
/// that a fluid adds included. What holds a body, or keeps it from turning, does the work that contacts on it
/// do not.
void WorkMeter::add_bodies(double duration, const Particles& particles, Works& works) {
  const Bodies& bodies = model_.bodies;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    const std::uint32_t i = particles.body[k];
    const Twin &half = particles.half[k], &total = particles.force[k];
    const Vec3 held = particles.acceleration(k).head<3>();
    const Vec3 held_turning =
        particles.load.empty() ? Vec3(Vec3::Zero()) : Vec3(particles.load[k].angular.head<3>());
    const Twin& contacts = particles.contact_force.empty() ? total : particles.contact_force[k];
    const Vec3 force = contacts.linear.head<3>(), moment = contacts.angular.head<3>();
    const Vec3 acceleration = half.linear[3] * total.linear.head<3>() + held,
               turning = half.angular[3] * total.angular.head<3>() + held_turning;
    velocity_[i] = half.linear.head<3>() + 0.5 * duration * acceleration;
    spin_[i] = half.angular.head<3>() + 0.5 * duration * turning;
    if (bodies.is_free(i)) {
      const Vec3 weight = bodies.mass[i] * model_.gravity;
      works.conservative += duration * weight.dot(velocity_[i]);
      works.loads += duration * (bodies.mass[i] * acceleration - force - weight).dot(velocity_[i]);
    } else {
      works.boundaries -= duration * force.dot(velocity_[i]);
    }
    if (half.angular[3] > 0)
      works.loads += duration * (bodies.inertia[i] * turning - moment).dot(spin_[i]);
    else
      works.boundaries -= duration * moment.dot(spin_[i]);
  }
}

void WorkMeter::add_contact(double duration, const ContactForce& c, Works& works) const {
  const bool wall = c.b == no_body;
  const Vec3 &velocity_b = wall ? c.wall_velocity : velocity_[c.b], &spin_b = wall ? c.wall_spin : spin_[c.b];
  const Vec3 velocity = velocity_[c.a] - velocity_b, moment = c.normal.cross(c.friction);
  const double parting = -duration * velocity.dot(c.normal);
  works.conservative += c.elastic * parting;
  works.damping += c.damping * parting;
  works.friction +=
      duration * (c.friction.dot(velocity) + moment.dot(c.arm_a * spin_[c.a] + c.arm_b * spin_b));
  works.turning += duration * c.resistance.dot(spin_[c.a] - spin_b);
  if (!wall) return;
  const Vec3 force = c.friction - (c.elastic + c.damping) * c.normal;
  works.boundaries += duration * (force.dot(velocity_b) + (c.resistance - c.arm_b * moment).dot(spin_b));
}

}  // namespace fpi::dem
