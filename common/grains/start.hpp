/// Whether the bodies can be where the scene puts them at the start.
#pragma once

#include "core/findings.hpp"
#include "grains/sphere.hpp"
#include "scene/scene.hpp"

namespace fpi::grains {

/// The disc or sphere, or the smallest circle around the vertices of a polygon that has its position as
/// centre.
Sphere sphere_around(const scene::Body& body);

/// Errors: each free body whose centre is outside the rectangle of fluid or the periodic cell, and each free
/// one that overlaps another by more than dem.start_overlap. Warnings: bodies that are not free and do.
Findings start_findings(const scene::Scene& scene);

}  // namespace fpi::grains
