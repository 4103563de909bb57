/// Walls: surfaces of facets that stop the grains, at rest or moving as rigid bodies, and the places where a
/// grain touches them. Facets that join make one surface: a place on their joint pushes once.
#pragma once

#include <string>

#include "dem/base/rotation.hpp"
#include "dem/walls/facet_grid.hpp"

namespace fpi::dem {

struct Wall {
  std::string name;
  std::size_t material = 0;
  bool moves = false;
  Vec3 centre = Vec3::Zero();     ///< point that it turns about, as the facets are given [m]
  double extent = 0;              ///< of the facets from the centre [m]; infinite of a plane
  Box box{};                      ///< around the facets
  std::uint32_t first_facet = 0;  ///< its first among those of all walls
  FacetGrid grid{};               ///< of its facets
};

/// All walls, and their facets where they are at the start.
struct Walls {
  std::vector<Wall> walls;
  std::vector<Facet> facets;
  std::vector<std::uint32_t> wall_of;  ///< each facet's wall

  /// Takes up a wall of these facets.
  void add(Wall wall, std::vector<Facet> of);
  const Wall& with(std::uint32_t facet) const { return walls[wall_of[facet]]; }
};

/// Where a wall is and how it moves.
struct WallMotion {
  Vec3 position = Vec3::Zero();  ///< of its centre [m]
  Quaternion orientation = Quaternion::Identity();
  Vec3 velocity = Vec3::Zero();  ///< of its centre [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]

  /// Goes on for `duration` [s] as it moves now.
  void drift(double duration);
  /// Velocity [m/s] of its frame at a place.
  Vec3 velocity_at(const Vec3& place) const { return velocity + spin.cross(place - position); }
};

using WallMotions = std::vector<WallMotion>;

/// Every wall where it is at the start.
WallMotions at_start(const Walls& walls);

/// A place as the wall saw it at the start, before it moved.
Vec3 into_wall(const Wall& wall, const WallMotion& motion, const Vec3& place);

/// The point of a facet that is nearest to x, where the walls are now, or of an image of it that is `shift`
/// [m] from there.
Nearest nearest(const Walls& walls, const WallMotions& motions, std::uint32_t facet, const Vec3& x,
                const Vec3& shift = Vec3::Zero());

/// A facet near a grain.
struct NearFacet {
  std::uint32_t facet = 0;
  Nearest at{};
  Vec3 shift = Vec3::Zero();  ///< of the facet's image that is near [m]
};

/// Of the facets near one grain, leaves those that it can touch by themselves, the nearest first: the local
/// minima of its distance from all of the surface. A place on an edge or corner goes where another facet
/// through that place comes nearer or as near: a face beats its edges, an edge its corners, and what two
/// facets share counts once. Faces have places of their own unless they coincide. Places nearer to each
/// other than `same` [m] are one.
void keep_own_places(const Walls& walls, const WallMotions& motions, double same,
                     std::vector<NearFacet>& near);

}  // namespace fpi::dem
