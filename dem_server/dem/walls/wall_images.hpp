/// Images of walls in a periodic box: a wall that ends is there again in every box, and a grain meets the
/// images that are near it. A wall that does not fit the box, as it would not meet its own images, is
/// refused.
#pragma once

#include "dem/base/periodic_box.hpp"
#include "dem/walls/walls.hpp"
#include "scene/walls.hpp"

namespace fpi::dem {

/// All images from the first to the last along each axis.
struct ImageRange {
  Image first{}, last{};
};

/// Images of a wall, where it is now, of which x may be within `within` [m]; a plane is its own image. Of a
/// wall as long as the box or longer, which repeats itself, no more than it takes to have all of it.
ImageRange images_near(const PeriodicBox& box, const Wall& wall, const WallMotion& motion, const Vec3& x,
                       double within);

template <class Visit>
void each_image(const ImageRange& range, Visit visit) {
  const auto& [first, last] = range;
  for (Image i{first}; i[2] <= last[2]; ++i[2])
    for (i[1] = first[1]; i[1] <= last[1]; ++i[1])
      for (i[0] = first[0]; i[0] <= last[0]; ++i[0]) visit(i);
}

/// Throws Error naming a wall that does not fit the box: a plane that is not parallel to the periodic axes, a
/// wall that reaches from one side to the other and does not go on there as its image, one that turns and
/// reaches farther than its image.
void check_fit(const PeriodicBox& box, const Wall& wall, std::span<const Facet> facets,
               const scene::Wall& declared);

}  // namespace fpi::dem
