#include "dem/forces.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::dem {
namespace {

double half_step_approach(const std::vector<Vec3>& velocity, double sub_step) {
  double fastest_squared = 0;
  for (const Vec3& v : velocity) fastest_squared = std::max(fastest_squared, v.squaredNorm());
  return sub_step * std::sqrt(fastest_squared);
}

}  // namespace

ContactCount add_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                          double stretch_time, double duration, Neighbours& neighbours,
                          WallContacts& wall_contacts, Forces& forces) {
  const SubStep sub_step{stretch_time, duration, half_step_approach(velocities.now, duration)};
  ContactCount count;
  with_elastic_law(model.elasticity, [&](auto law) {
    add_list<decltype(law)>(model, position, velocities, sub_step, neighbours, forces, count);
    add_list<decltype(law)>(model, position, velocities, sub_step, wall_contacts, forces, count);
  });
  return count;
}

}  // namespace fpi::dem
