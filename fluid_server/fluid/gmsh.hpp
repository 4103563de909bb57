/// Gmsh meshes, ASCII format 2.2 and 4.1: triangles of first or second order (also mixed), and lines in named
/// physical groups. A line in several groups belongs to the first of them that has a name.
#pragma once

#include <string>
#include <string_view>

#include "fluid/mesh.hpp"

namespace fpi::fluid {

/// Reads the text of a .msh file; `name` stands for it in errors. Vertices that no triangle uses are dropped.
/// Throws Error (format, what came, what to do) for anything else.
Mesh read_gmsh(std::string_view text, const std::string& name);

}  // namespace fpi::fluid
