#include "dem/integrate/sweep.hpp"

#include "core/parallel.hpp"
#include "dem/base/lane_vectors.hpp"

namespace fpi::dem {
namespace {

constexpr std::size_t chunk = 2048;  ///< bodies that one thread takes at once

LaneVector3 load_vector(const Record* four) {
  Lanes x = load(four[0].data()), y = load(four[1].data()), z = load(four[2].data()),
        w = load(four[3].data());
  transpose(x, y, z, w);
  return {x, y, z};
}

/// Orientation::turn for four bodies at once where all their turns are small, as nearly always.
void turn(Particles& particles, std::size_t first, double duration, std::vector<Orientation>& orientation) {
  Record spins[n_lanes];
  for (std::size_t k = 0; k < n_lanes; ++k) spins[k] = particles.half[first + k].angular;
  const LaneVector3 theta = duration * load_vector(spins), since = load_vector(&particles.turned[first]);
  const Lanes half_squared = 0.25 * theta.dot(theta);
  if (!holds_everywhere((half_squared < 1e-4) & (since.dot(since) < 1))) {
    const std::size_t last = std::min(first + n_lanes, particles.size());
    for (std::size_t i = first; i < last; ++i) {
      Orientation& turning = orientation[particles.body[i]];
      turning.since = particles.turned[i].head<3>();
      turning.turn(duration * particles.half[i].angular.head<3>());
      particles.turned[i].head<3>() = turning.since;
    }
    return;
  }
  const LaneVector3 increment = rescaling_of_small(half_squared) * theta;
  const LaneVector3 turned =
      4 / (4 - since.dot(increment)) * (since + increment - 0.5 * since.cross(increment));
  Lanes x = turned.x, y = turned.y, z = turned.z, w{};
  transpose(x, y, z, w);
  store(x, particles.turned[first].data());
  store(y, particles.turned[first + 1].data());
  store(z, particles.turned[first + 2].data());
  store(w, particles.turned[first + 3].data());
}

/// The largest size of each component of the velocities on the way.
Lanes sweep_chunk(const Sweep& sweep, std::size_t first, std::size_t last, Particles& particles,
                  std::vector<Orientation>& orientation) {
  const Lanes drift{sweep.drift, sweep.drift, sweep.drift, 0};
  const bool loaded = !particles.load.empty();
  const Lanes gravity = load(particles.gravity.data());
  Lanes fastest{};
  for (std::size_t i = first; i < last; ++i) {
    Twin &half = particles.half[i], &force = particles.force[i], &now = particles.now[i];
    const Lanes acceleration =
        half.linear[3] * load(force.linear.data()) + (loaded ? load(particles.load[i].linear.data())
                                                      : half.linear[3] > 0 ? gravity
                                                                           : Lanes{});
    const Lanes turning = half.angular[3] * load(force.angular.data()) +
                          (loaded ? load(particles.load[i].angular.data()) : Lanes{});
    const Lanes velocity = load(half.linear.data()) + sweep.kick * acceleration;
    const Lanes spin = load(half.angular.data()) + sweep.kick * turning;
    const Lanes place = load(particles.place[i].data()) + drift * velocity;
    Lanes spin_now = spin + sweep.extrapolate * turning;
    spin_now[3] = place[3];
    store(velocity, half.linear.data());
    store(spin, half.angular.data());
    store(place, particles.place[i].data());
    store(velocity + sweep.extrapolate * acceleration, now.linear.data());
    store(spin_now, now.angular.data());
    if (sweep.clear) force = {};
    fastest = max(fastest, abs(velocity));
  }
  if (sweep.drift == 0) return fastest;
  for (std::size_t i = first; i < last; i += n_lanes) turn(particles, i, sweep.drift, orientation);
  return fastest;
}

}  // namespace

double Sweep::operator()(Particles& particles, std::vector<Orientation>& orientation) const {
  const std::size_t n = particles.place.size(), n_chunks = (n + chunk - 1) / chunk;
  std::vector<Lanes> fastest(n_chunks);
  parallel_for(static_cast<int>(n_chunks), [&](int c) {
    const std::size_t first = static_cast<std::size_t>(c) * chunk;
    fastest[static_cast<std::size_t>(c)] =
        sweep_chunk(*this, first, std::min(first + chunk, n), particles, orientation);
  });
  Lanes largest{};
  for (const Lanes& of_chunk : fastest) largest = max(largest, of_chunk);
  return std::sqrt(largest[0] * largest[0] + largest[1] * largest[1] + largest[2] * largest[2]);
}

}  // namespace fpi::dem
