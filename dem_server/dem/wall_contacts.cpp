#include "dem/wall_contacts.hpp"

namespace fpi::dem {
namespace {

constexpr double same = 1e-3;  ///< of the radius: places nearer to each other are one
constexpr double joint = 0.1;  ///< of the radius: how far a contact may jump from facet to facet

bool has(const std::vector<NearFacet>& places, std::uint32_t facet) {
  return std::ranges::find(places, facet, &NearFacet::facet) != places.end();
}

/// Contacts of one body that begin take over the memories of those that end at the same place of other
/// facets.
void hand_over(const Model& model, const Vec3& x, const std::vector<NearFacet>& own, std::size_t first,
               std::size_t last, WallContacts& contacts) {
  const double within = joint * model.bodies.radius[contacts.places[first].body];
  const auto facet = [&](std::size_t p) { return contacts.places[p].facet; };
  for (std::size_t ends = first; ends < last; ++ends) {
    if (contacts.memories[ends].empty() || has(own, facet(ends))) continue;
    const Vec3 place = nearest(model.walls, contacts.motions, facet(ends), x).place;
    for (std::size_t p = first; p < last; ++p) {
      const auto begins = std::ranges::find(own, facet(p), &NearFacet::facet);
      if (begins == own.end() || !contacts.memories[p].empty()) continue;
      if ((begins->at.place - place).norm() <= within) {
        std::swap(contacts.memories[p], contacts.memories[ends]);
        break;
      }
    }
  }
}

}  // namespace

void WallContacts::drift(double duration) {
  for (WallMotion& motion : motions) motion.drift(duration);
  moved += duration * speed;
}

double largest_speed(const Walls& walls, const WallMotions& motions, const std::vector<Vec3>& position) {
  double largest = 0;
  for (std::size_t w = 0; w < motions.size(); ++w) {
    const WallMotion& motion = motions[w];
    double arm = walls.walls[w].extent;
    if (std::isinf(arm)) {
      arm = 0;
      for (const Vec3& x : position) arm = std::max(arm, (x - motion.position).norm());
    }
    largest = std::max(largest, motion.velocity.norm() + motion.spin.norm() * arm);
  }
  return largest;
}

void search_walls(const Model& model, const std::vector<Vec3>& position, double widest_gap,
                  WallContacts& contacts) {
  const Walls& walls = model.walls;
  std::vector<WallPlace> found;
  std::vector<std::uint32_t> facets;
  for (std::uint32_t i = 0; i < position.size(); ++i) {
    if (!model.bodies.is_free(i)) continue;
    const double within = model.bodies.radius[i] + widest_gap;
    for (std::size_t w = 0; w < walls.walls.size(); ++w) {
      const Wall& wall = walls.walls[w];
      const Vec3 x = into_wall(wall, contacts.motions[w], model.periodic.inside(position[i]));
      wall.grid.find({x - Vec3::Constant(within), x + Vec3::Constant(within)}, facets);
      for (const std::uint32_t f : facets) {
        const std::uint32_t facet = wall.first_facet + f;
        if (nearest(walls.facets[facet], x).distance <= within) found.push_back({i, facet});
      }
    }
  }
  contacts.replace(std::move(found));
  contacts.moved = 0;
}

Near near(const Model& model, const WallMotions& motions, std::uint32_t body, const NearFacet& facet) {
  const Wall& wall = model.walls.with(facet.facet);
  const WallMotion& motion = motions[model.walls.wall_of[facet.facet]];
  const Vec3 x = facet.at.place + facet.at.distance * facet.at.normal;
  return {.a = body,
          .b = no_body,
          .at = {-facet.at.normal, facet.at.distance - model.bodies.radius[body]},
          .law = model.laws(model.bodies.material[body], wall.material),
          .frame = {.velocity = motion.velocity_at(x),
                    .spin = motion.spin,
                    .acceleration = motion.spin.squaredNorm() * (x - motion.position).norm(),
                    .straight = is_convex(model.walls.facets[facet.facet]) && motion.spin.isZero(0)}};
}

Near near(const Model& model, const std::vector<Vec3>& position, const WallMotions& motions,
          const WallPlace& place) {
  const Nearest at = nearest(model.walls, motions, place.facet, model.periodic.inside(position[place.body]));
  return near(model, motions, place.body, {place.facet, at});
}

std::vector<NearFacet> own_places(const Model& model, const std::vector<Vec3>& position,
                                  const WallContacts& contacts, std::size_t first, std::size_t last,
                                  double reach) {
  const std::uint32_t body = contacts.places[first].body;
  const Vec3 x = model.periodic.inside(position[body]);
  const double R = model.bodies.radius[body];
  std::vector<NearFacet> own;
  for (std::size_t p = first; p < last; ++p) {
    const std::uint32_t facet = contacts.places[p].facet;
    const Nearest at = nearest(model.walls, contacts.motions, facet, x);
    if (at.distance - R <= reach) own.push_back({facet, at});
  }
  keep_own_places(model.walls, contacts.motions, same * R, own);
  return own;
}

void add_wall_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                       const SubStep& sub_step, WallContacts& contacts, Forces& forces, ContactCount& count) {
  each_body_at_walls(contacts, [&](std::size_t first, std::size_t last) {
    const std::uint32_t body = contacts.places[first].body;
    const std::vector<NearFacet> own = own_places(model, position, contacts, first, last, sub_step.reach);
    hand_over(model, model.periodic.inside(position[body]), own, first, last, contacts);
    for (std::size_t p = first; p < last; ++p) {
      const auto facet = std::ranges::find(own, contacts.places[p].facet, &NearFacet::facet);
      if (facet == own.end()) {
        contacts.memories[p] = {};
      } else {
        with_elastic_law(model.elasticity, [&](auto law) {
          add_place<decltype(law)>(model, near(model, contacts.motions, body, *facet), contacts.places[p],
                                   velocities, sub_step, contacts.memories[p], forces, count);
        });
      }
    }
  });
}

std::string names(const Model& model, const WallPlace& place) {
  return model.bodies.name[place.body] + " and " + model.walls.with(place.facet).name;
}

}  // namespace fpi::dem
