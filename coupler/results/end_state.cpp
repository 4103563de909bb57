#include "results/end_state.hpp"

#include <algorithm>
#include <iterator>

#include "output/table.hpp"

namespace fpi {

std::string final_bodies_file(const std::string& folder) { return folder + "/final_bodies.csv"; }

std::vector<std::string> end_state_columns(const scene::Scene& scene) {
  if (scene.bodies.front().is_plane()) return {"x", "y", "radius", "vx", "vy", "spin"};
  return {"x", "y", "z", "radius", "vx", "vy", "vz", "spin_x", "spin_y", "spin_z"};
}

std::vector<double> end_state(const scene::Scene& scene, std::size_t body,
                              const coupling::RigidMotion& motion) {
  const bool plane = scene.bodies[body].is_plane();
  const std::ptrdiff_t axes = plane ? 2 : 3;
  const Eigen::Vector3d place = scene.periodic.inside(motion.position);
  std::vector<double> entries(place.begin(), place.begin() + axes);
  entries.push_back(scene.bodies[body].radius);
  entries.insert(entries.end(), motion.velocity.begin(), motion.velocity.begin() + axes);
  entries.insert(entries.end(), motion.spin.begin() + (plane ? 2 : 0), motion.spin.end());
  return entries;
}

void write_final_bodies(const scene::Scene& scene, const CoupledState& state, const std::string& folder) {
  if (!scene.moves_freely()) return;
  std::vector<double> entries;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].is_free() && state.is_there(i))
      std::ranges::copy(end_state(scene, i, state.motions[i]), std::back_inserter(entries));
  output::write_table(final_bodies_file(folder), end_state_columns(scene), entries);
}

}  // namespace fpi
