/// How far a body at rest sinks into what carries it: what says, before a run, that a material is too soft.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace fpi::grains {

/// Of a body that lies on something by its weight less its buoyancy.
struct StaticOverlap {
  std::size_t body = 0;
  std::string on;    ///< "wall floor", or "another body"
  double share = 0;  ///< of its radius
};

/// The deepest overlap of a free body on a wall or on a body like it; share 0 where nothing has weight. Those
/// above are not counted.
StaticOverlap deepest_static_overlap(const scene::Scene& scene);

/// A sentence where that is more than a twentieth of the radius, for a warning.
std::vector<std::string> soft_materials(const scene::Scene& scene);

}  // namespace fpi::grains
