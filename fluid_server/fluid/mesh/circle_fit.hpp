/// Puts a named part of the boundary on a circle, so that a mesh of straight triangles describes a round body
/// or wall as well as its elements can.
#pragma once

#include <string>

#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// Moves the vertices and middles of the edges of `boundary` along the radius onto the circle [m]. Throws
/// Error where the mesh has no such boundary, where a vertex lies farther from the circle than a quarter of
/// its edge, or where a triangle would be turned over.
void fit_circle(Mesh& mesh, const std::string& boundary, const Vec2& centre, double radius);

}  // namespace fpi::fluid
