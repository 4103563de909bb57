/// The superficial velocity of a flow through bodies: what a filter law such as Darcy's speaks of.
#pragma once

#include "fluid/cut_mesh.hpp"

namespace fpi::fluid {

/// ∫u over the fluid, over the area of the rectangle around the mesh, bodies included [m/s]; `u`: x, y of
/// each node.
Vec2 superficial_velocity(const Mesh& mesh, const CutMesh& cut, const Vector& u);

}  // namespace fpi::fluid
