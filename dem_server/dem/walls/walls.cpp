#include "dem/walls/walls.hpp"

#include <algorithm>

namespace fpi::dem {

void Walls::add(Wall wall, std::vector<Facet> of) {
  wall.first_facet = static_cast<std::uint32_t>(facets.size());
  wall.grid = FacetGrid(of);
  for (const Facet& facet : of) {
    const Box box = bounds(facet);
    wall.box.extend(box);
    const Vec3 farthest = (box.min() - wall.centre).cwiseAbs().cwiseMax((box.max() - wall.centre).cwiseAbs());
    wall.extent = std::max(wall.extent, farthest.norm());
  }
  wall_of.insert(wall_of.end(), of.size(), static_cast<std::uint32_t>(walls.size()));
  facets.insert(facets.end(), of.begin(), of.end());
  walls.push_back(std::move(wall));
}

WallMotions at_start(const Walls& walls) {
  WallMotions motions;
  for (const Wall& wall : walls.walls) motions.push_back({.position = wall.centre});
  return motions;
}

void WallMotion::drift(double duration) {
  position += duration * velocity;
  if (!spin.isZero(0)) orientation = (quaternion(rescaled(duration * spin)) * orientation).normalized();
}

Vec3 into_wall(const Wall& wall, const WallMotion& motion, const Vec3& place) {
  if (!wall.moves) return place;
  return motion.orientation.conjugate() * (place - motion.position) + wall.centre;
}

Nearest nearest(const Walls& walls, const WallMotions& motions, std::uint32_t facet, const Vec3& x,
                const Vec3& shift) {
  const Wall& wall = walls.with(facet);
  const WallMotion& motion = motions[walls.wall_of[facet]];
  Nearest found = nearest(walls.facets[facet], into_wall(wall, motion, x - shift));
  if (wall.moves) {
    found.place = motion.orientation * (found.place - wall.centre) + motion.position;
    found.normal = motion.orientation * found.normal;
  }
  found.place += shift;
  return found;
}

void keep_own_places(const Walls& walls, const WallMotions& motions, double same,
                     std::vector<NearFacet>& near) {
  if (near.size() < 2) return;
  std::ranges::stable_sort(near, {}, [](const NearFacet& facet) { return facet.at.distance; });
  const auto is_own = [&](std::size_t i, const std::vector<NearFacet>& kept) {
    const Vec3& place = near[i].at.place;
    if (near[i].at.on_face)
      return std::ranges::none_of(kept,
                                  [&](const NearFacet& k) { return (k.at.place - place).norm() <= same; });
    return std::none_of(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(i), [&](const NearFacet& k) {
      return nearest(walls, motions, k.facet, place, k.shift).distance <= same;
    });
  };
  std::vector<NearFacet> kept;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (is_own(i, kept)) kept.push_back(near[i]);
  near = std::move(kept);
}

}  // namespace fpi::dem
