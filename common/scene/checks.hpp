/// What must hold between the groups of a scene: names that are unique and refer to something, dimensions
/// that agree, boundaries that all have a condition.
#pragma once

#include "scene/scene.hpp"

namespace fpi::scene {

/// Reports each condition to `v.require`, with the dotted key that breaks it.
void check(const Scene& scene, ParameterVisitor& v);

}  // namespace fpi::scene
