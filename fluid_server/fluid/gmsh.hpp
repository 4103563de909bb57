/// Gmsh meshes, ASCII format 2.2 and 4.1: first-order triangles, and lines in named physical groups.
#pragma once

#include <string>
#include <string_view>

#include "fluid/mesh.hpp"

namespace fpi::fluid {

/// Reads the text of a .msh file; `name` stands for it in errors. Vertices that no triangle uses are dropped.
/// Throws Error (format, what came, what to do) for anything else.
Mesh read_gmsh(std::string_view text, const std::string& name);

}  // namespace fpi::fluid
