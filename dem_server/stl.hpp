/// Triangles from the bytes of an STL file, text or binary. What was read is hostile until it is checked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem/walls/facets.hpp"

namespace fpi::dem {

struct StlMesh {
  std::vector<Corners> triangles;  ///< in the unit of the file
  std::string note;                ///< what the user should know of it; empty: nothing
};

/// Text is read in double precision, its keywords in capitals or not. A binary file holds single precision; a
/// note says where that is coarse. Throws Error naming the file (and the line of a text) where it holds no
/// triangles, or numbers that are not finite.
StlMesh read_stl(std::string_view bytes, const std::string& name);

}  // namespace fpi::dem
