/// The mesh that a scene asks for.
#pragma once

#include <string_view>

#include "fluid/mesh/mesh.hpp"
#include "scene/fluid.hpp"
#include "scene/periodic.hpp"

namespace fpi::fluid {

/// A rectangle from the scene's numbers, or the Gmsh mesh whose text came with it, joined where the scene is
/// periodic. Throws Error naming the file where it cannot be the scene's mesh.
Mesh scene_mesh(const scene::Fluid& fluid, const scene::Periodic& periodic, std::string_view file_text);

}  // namespace fpi::fluid
