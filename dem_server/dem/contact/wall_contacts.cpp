#include "dem/contact/wall_contacts.hpp"

#include "dem/walls/wall_images.hpp"

namespace fpi::dem {
namespace {

constexpr double same = 1e-3;  ///< of the radius: places nearer to each other are one
constexpr double joint = 0.1;  ///< of the radius: how far a contact may jump from facet to facet

/// That of the near facets that is the facet of a place, in the same image.
auto find_place(const Model& model, const std::vector<NearFacet>& near, const WallPlace& place) {
  return std::ranges::find_if(near, [&](const NearFacet& n) {
    return n.facet == place.facet && n.shift == model.periodic.shift(place.image);
  });
}

Nearest nearest(const Model& model, const WallMotions& motions, const WallPlace& place, const Vec3& x) {
  return nearest(model.walls, motions, place.facet, x, model.periodic.shift(place.image));
}

/// Contacts of one body that begin take over the histories of those that end at the same place of other
/// facets.
void hand_over(const Model& model, const Vec3& x, const std::vector<NearFacet>& own, std::size_t first,
               std::size_t last, WallContacts& contacts) {
  const double within = joint * model.bodies.radius[contacts.places[first].body];
  for (std::size_t ends = first; ends < last; ++ends) {
    if (contacts.histories[ends].empty() || find_place(model, own, contacts.places[ends]) != own.end())
      continue;
    const Vec3 place = nearest(model, contacts.motions, contacts.places[ends], x).place;
    for (std::size_t p = first; p < last; ++p) {
      const auto begins = find_place(model, own, contacts.places[p]);
      if (begins == own.end() || !contacts.histories[p].empty()) continue;
      if ((begins->at.place - place).norm() <= within) {
        std::swap(contacts.histories[p], contacts.histories[ends]);
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
      const WallMotion& motion = contacts.motions[w];
      each_image(images_near(model.periodic, wall, motion, position[i], within), [&](const Image& image) {
        const Vec3 x = into_wall(wall, motion, position[i] - model.periodic.shift(image));
        wall.grid.find({x - Vec3::Constant(within), x + Vec3::Constant(within)}, facets);
        for (const std::uint32_t f : facets) {
          const std::uint32_t facet = wall.first_facet + f;
          if (nearest(walls.facets[facet], x).distance <= within) found.push_back({i, facet, image});
        }
      });
    }
  }
  if (model.periodic.repeats()) std::ranges::sort(found);
  contacts.replace(std::move(found));
  contacts.moved = 0;
}

Near near(const Model& model, const WallMotions& motions, std::uint32_t body, const NearFacet& facet) {
  const Wall& wall = model.walls.with(facet.facet);
  const WallMotion& motion = motions[model.walls.wall_of[facet.facet]];
  const Vec3 x = facet.at.place + facet.at.distance * facet.at.normal - facet.shift;
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
  const Nearest at = nearest(model, motions, place, position[place.body]);
  return near(model, motions, place.body, {place.facet, at, model.periodic.shift(place.image)});
}

std::vector<NearFacet> own_places(const Model& model, const std::vector<Vec3>& position,
                                  const WallContacts& contacts, std::size_t first, std::size_t last,
                                  double reach) {
  const std::uint32_t body = contacts.places[first].body;
  const double R = model.bodies.radius[body];
  std::vector<NearFacet> own;
  for (std::size_t p = first; p < last; ++p) {
    const WallPlace& place = contacts.places[p];
    const Nearest at = nearest(model, contacts.motions, place, position[body]);
    if (at.distance - R <= reach) own.push_back({place.facet, at, model.periodic.shift(place.image)});
  }
  keep_own_places(model.walls, contacts.motions, same * R, own);
  return own;
}

void add_wall_contacts(const Model& model, const std::vector<Vec3>& position, const Velocities& velocities,
                       const SubStep& sub_step, WallContacts& contacts, Forces& forces, ContactCount& count) {
  each_body_at_walls(contacts, [&](std::size_t first, std::size_t last) {
    const std::uint32_t body = contacts.places[first].body;
    const std::vector<NearFacet> own = own_places(model, position, contacts, first, last, sub_step.reach);
    hand_over(model, position[body], own, first, last, contacts);
    for (std::size_t p = first; p < last; ++p) {
      const auto facet = find_place(model, own, contacts.places[p]);
      if (facet == own.end()) {
        contacts.histories[p] = {};
      } else {
        with_elastic_law(model.elasticity, [&](auto law) {
          add_place<decltype(law)>(model, near(model, contacts.motions, body, *facet), contacts.places[p],
                                   velocities, sub_step, contacts.histories[p], forces, count);
        });
      }
    }
  });
}

std::string names(const Model& model, const WallPlace& place) {
  return model.bodies.name[place.body] + " and " + model.walls.with(place.facet).name;
}

}  // namespace fpi::dem
