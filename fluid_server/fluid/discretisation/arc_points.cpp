#include "fluid/discretisation/arc_points.hpp"

#include <algorithm>

#include "fluid/base/quadrature.hpp"

namespace fpi::fluid {

std::array<ArcPoint, 4> arc_points(const Space& space, const Interface& interface, const ArcPiece& piece) {
  std::array<ArcPoint, 4> points;
  const double length = interface.surface.length(piece.start, piece.end);
  const Triangle& triangle = space.triangles[piece.cell];
  std::ranges::transform(gauss_legendre(4), points.begin(), [&](const LinePoint& point) -> ArcPoint {
    const double parameter = piece.start + point.s * (piece.end - piece.start);
    const Vec2 x = interface.surface.at(parameter);
    return {parameter, x, p2_at(triangle.barycentric(x + piece.shift)), point.weight * length};
  });
  return points;
}

}  // namespace fpi::fluid
