/// Places on a regular lattice in a box.
#pragma once

#include <string>
#include <vector>

#include "grains/sphere.hpp"

namespace fpi::grains {

/// Centres with `spacing` [m] between neighbours, the first ones `margin` [m] away from the lower sides and
/// none nearer than that to the upper ones; row after row, layer after layer upwards. `kind` is one of
/// scene::Grains::lattices.
std::vector<Vec3> lattice(const std::string& kind, const Box& box, double spacing, double margin);

}  // namespace fpi::grains
