#include "end_state.hpp"

#include <algorithm>

#include "output/table.hpp"

namespace fpi {
namespace {

std::vector<std::string> columns(bool plane) {
  if (plane) return {"x", "y", "radius", "vx", "vy", "spin"};
  return {"x", "y", "z", "radius", "vx", "vy", "vz", "spin_x", "spin_y", "spin_z"};
}

}  // namespace

std::string final_bodies_file(const std::string& folder) { return folder + "/final_bodies.csv"; }

void write_final_bodies(const scene::Scene& scene, const std::vector<coupling::RigidMotion>& motions,
                        const std::string& folder) {
  if (!scene.moves_freely()) return;
  const bool plane = scene.bodies.front().is_plane();
  const std::ptrdiff_t axes = plane ? 2 : 3;
  output::Table table(final_bodies_file(folder), columns(plane));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].is_free()) continue;
    const coupling::RigidMotion& motion = motions[i];
    const Eigen::Vector3d place = scene.periodic.inside(motion.position);
    std::vector<double> line(place.begin(), place.begin() + axes);
    line.push_back(scene.bodies[i].radius);
    line.insert(line.end(), motion.velocity.begin(), motion.velocity.begin() + axes);
    line.insert(line.end(), motion.spin.begin() + (plane ? 2 : 0), motion.spin.end());
    table.append(line);
  }
}

}  // namespace fpi
