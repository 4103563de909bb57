/// Triangles from the bytes of an STL file, text or binary. What was read is hostile until it is checked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem/facets.hpp"

namespace fpi::dem {

/// Throws Error naming the file where it holds no triangles, or numbers that are not finite.
std::vector<Corners> read_stl(std::string_view bytes, const std::string& name);

}  // namespace fpi::dem
