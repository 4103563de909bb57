#include "results/groups.hpp"

namespace fpi {

std::vector<GroupMotion> group_motions(const scene::Scene& scene, const CoupledState& state) {
  std::vector<GroupMotion> out;
  std::size_t first = scene.n_listed();
  for (const scene::Grains& grains : scene.grains) {
    GroupMotion& group = out.emplace_back(GroupMotion{.name = grains.name});
    const double shape_factor = grains.is_plane() ? 0.5 : 0.4;  // of the moment of inertia
    double total = 0;
    for (std::size_t i = first; i < first + grains.count; ++i) {
      if (!state.is_there(i)) continue;
      ++group.count;
      const double R = scene.bodies[i].radius, volume = scene.bodies[i].volume(R, scene.thickness);
      const coupling::RigidMotion& m = state.motions[i];
      total += volume;
      group.position += volume * m.position;
      group.velocity += volume * m.velocity;
      group.kinetic_energy += 0.5 * grains.density * volume *
                              (m.velocity.squaredNorm() + shape_factor * R * R * m.spin.squaredNorm());
    }
    group.position /= total;
    group.velocity /= total;
    first += grains.count;
  }
  return out;
}

}  // namespace fpi
