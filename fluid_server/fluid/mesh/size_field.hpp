/// The element size that a scene wants at each place: small in the regions of its refinements, growing with
/// the distance from them.
#pragma once

#include <span>

#include "fluid/base/types.hpp"
#include "scene/fluid.hpp"

namespace fpi::fluid {

/// Distance from the region of a refinement [m]: a box (0 inside), a circle line or a polyline.
double distance(const scene::Refinement& region, const Vec2& x);

/// The least of size + growth · distance over the refinements [m], at the place within `reach` of x where it
/// is least; infinite without refinements.
double wanted_size(std::span<const scene::Refinement> refinements, const Vec2& x, double reach);

}  // namespace fpi::fluid
