/// Whether the bodies can be where the scene puts them at the start.
#pragma once

#include "grains/sphere.hpp"
#include "scene/scene.hpp"

namespace fpi::grains {

/// The disc or sphere, or the smallest circle around the vertices of a polygon that has its position as
/// centre.
Sphere sphere_around(const scene::Body& body);

/// Throws Error naming a free body whose centre is outside the rectangle of fluid or the periodic cell, or a
/// free one and another that overlap by more than dem.start_overlap.
void check_start(const scene::Scene& scene);

}  // namespace fpi::grains
