/// The energy account of a run: what bodies and contacts have, what was lost and where, what came from
/// outside. Works are those of leapfrog, whose kinetic energy changes in a kick by force × mean velocity
/// exactly; so kinetic energy and works agree to round-off, and what stored energies differ by is the error
/// of the steps.
#pragma once

#include <array>
#include <span>

#include "dem/contact/particles.hpp"
#include "dem/contact/state.hpp"

namespace fpi::dem {

/// Of a state whose neighbours are found.
Energies energies(const Model& model, const State& state);

/// The entries of scene::Dem::energies, in that order [J]: kinetic + potential + elastic + lost − supplied −
/// numerical is what it was at the start, to round-off.
using EnergyAccount = std::array<double, scene::Dem::energies.size()>;
EnergyAccount energy_account(const Energies& start, const Energies& now, const State& state);

/// Takes down the work of kicks.
class WorkMeter {
 public:
  explicit WorkMeter(const Model& model) : model_(model), velocity_(model.bodies.size()), spin_(velocity_) {}

  /// Of a kick of `duration` [s] that is about to come, by the forces that stand, `contacts` among them.
  void add_kick(double duration, const Particles& particles, std::span<const ContactForce> contacts,
                Works& works);

 private:
  void add_bodies(double duration, const Particles& particles, Works& works);
  void add_contact(double duration, const ContactForce& contact, Works& works) const;

  const Model& model_;
  std::vector<Vec3> velocity_, spin_;  ///< means over the kick [m/s], [rad/s]
};

/// ½ m v² + ½ I ω² of the free bodies, by their own mass [J].
double kinetic_energy(const Bodies& bodies, std::span<const Vec3> velocity, std::span<const Vec3> spin);

}  // namespace fpi::dem
