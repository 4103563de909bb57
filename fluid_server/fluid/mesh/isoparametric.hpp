/// Geometry of triangles and edges whose middle nodes may lie off the chord: the inverse of the P2 map, where
/// it is folded, and parabolas. The map itself and its derivatives are position_at and metric_at of
/// element.hpp.
#pragma once

#include <array>
#include <optional>

#include "fluid/base/types.hpp"

namespace fpi::fluid {

using Barycentric = std::array<double, 3>;
/// Places of the P2 nodes of a cell [m], in the order of Mesh::cell_nodes.
using CellNodes = std::array<Vec2, 6>;
/// Places of the P2 nodes of an edge [m]: start, end, middle.
using EdgeNodes = std::array<Vec2, 3>;

/// The l with Σ N_i(l) x_i = x by Newton's method, also a little outside of the triangle; nothing where there
/// is none near.
std::optional<Barycentric> isoparametric_inverse(const CellNodes& nodes, const Vec2& x);
/// Where the map is folded: a corner, middle or quadrature point whose Jacobian is not positive.
std::optional<Vec2> folded_place(const CellNodes& nodes);

/// P2 functions of the nodes of an edge at s in [0, 1].
std::array<double, 3> edge_shape(double s);
/// The parabola through the nodes of an edge at s in [0, 1], from start to end.
Vec2 edge_point(const EdgeNodes& nodes, double s);
/// dx/ds [m]; its norm is the length element, (y, −x) of it the normal to the right of the way.
Vec2 edge_tangent(const EdgeNodes& nodes, double s);

}  // namespace fpi::fluid
