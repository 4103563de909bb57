#include "dem/wall_contacts.hpp"

namespace fpi::dem {

void search_walls(const Model& model, const std::vector<Vec3>& position, double widest_gap,
                  WallContacts& contacts) {
  std::vector<WallPlace> found;
  for (std::uint32_t i = 0; i < position.size(); ++i) {
    if (!model.bodies.is_free(i)) continue;
    for (std::uint32_t w = 0; w < model.walls.size(); ++w) {
      if (near(model, position, WallPlace{i, w}).at.gap <= widest_gap) found.push_back({i, w});
    }
  }
  contacts.replace(std::move(found));
}

Near near(const Model& model, const std::vector<Vec3>& position, const WallPlace& place) {
  const Plane& wall = model.walls[place.wall];
  const double height = wall.normal.dot(position[place.body]) - wall.offset;
  return {place.body,
          no_body,
          {-wall.normal, height - model.bodies.radius[place.body]},
          model.laws(model.bodies.material[place.body], wall.material)};
}

std::string names(const Model& model, const WallPlace& place) {
  return model.bodies.name[place.body] + " and " + model.walls[place.wall].name;
}

}  // namespace fpi::dem
