#include "dem/forces.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::dem {
namespace {

double largest_speed(const std::vector<Vec3>& velocity) {
  double squared = 0;
  for (const Vec3& v : velocity) squared = std::max(squared, v.squaredNorm());
  return std::sqrt(squared);
}

}  // namespace

ContactCount add_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                          double stretch_time, double duration, Neighbours& neighbours,
                          WallContacts& wall_contacts, Forces& forces) {
  const double speed = std::max(largest_speed(velocities.now), wall_contacts.speed);
  // Nothing closes this gap within half a sub-step: damping acts from the half in which surfaces meet.
  const SubStep sub_step{stretch_time, duration, duration * speed};
  ContactCount count;
  with_elastic_law(model.elasticity, [&](auto law) {
    for (std::size_t p = 0; p < neighbours.places.size(); ++p) {
      const Pair& pair = neighbours.places[p];
      add_place<decltype(law)>(model, near(model, position, pair), pair, velocities, sub_step,
                               neighbours.memories[p], forces, count);
    }
  });
  add_wall_contacts(model, position, velocities, sub_step, wall_contacts, forces, count);
  return count;
}

}  // namespace fpi::dem
