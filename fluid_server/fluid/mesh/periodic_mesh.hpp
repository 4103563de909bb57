/// Makes opposite sides of a mesh the same: their nodes share unknowns, and the triangles on either side are
/// neighbours.
#pragma once

#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// Joins the sides of the mesh that lie in the period's planes; they are no boundaries any more, and names
/// that only they had are gone. Throws Error with the place where the mesh does not reach from plane to
/// plane, or where the two sides do not match node by node.
void make_periodic(Mesh& mesh, const Period& period);

/// Gives nodes (or vertices) that share unknowns the values of their owner: `values` holds `components` of
/// each.
void spread_to_copies(const Mesh& mesh, int components, Vector& values);

}  // namespace fpi::fluid
