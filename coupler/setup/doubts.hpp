/// What a scene asks for that is allowed, but that its author may not have meant.
#pragma once

#include "core/findings.hpp"
#include "scene/scene.hpp"

namespace fpi {

/// Warnings, of a scene with all its bodies.
Findings doubts(const scene::Scene& scene);

}  // namespace fpi
