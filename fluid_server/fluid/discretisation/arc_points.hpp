/// The quadrature along a piece of a surface inside one element.
#pragma once

#include <array>

#include "fluid/cut/cut_mesh.hpp"
#include "fluid/discretisation/space.hpp"

namespace fpi::fluid {

struct ArcPoint {
  double parameter;  ///< of the surface
  Vec2 x;            ///< on the body itself, not on the image that lies in the element [m]
  Padded shape;      ///< functions of the element's nodes there
  double weight;     ///< [m]
};

/// Gauss–Legendre points of a piece of `interface`'s surface.
std::array<ArcPoint, 4> arc_points(const Space& space, const Interface& interface, const ArcPiece& piece);

}  // namespace fpi::fluid
