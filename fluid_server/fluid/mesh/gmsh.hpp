/// Gmsh meshes, ASCII format 2.2 and 4.1, partitioned or not: triangles of first or second order (also mixed)
/// in a plane of constant z, and lines in named physical groups. Groups of one name are one boundary.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// Reads the text of a .msh file; `name` stands for it in errors. Vertices that no triangle uses are dropped.
/// An edge in several named groups belongs to the one among `conditions` (names of boundaries that the scene
/// has a condition for), else to the first. Throws Error (file, format, what came, what to do) for anything
/// else.
Mesh read_gmsh(std::string_view text, const std::string& name,
               const std::vector<std::string>& conditions = {});

}  // namespace fpi::fluid
