#include "fluid/discretisation/moving_part.hpp"

namespace fpi::fluid {
namespace {

/// ∫u (∇·w − ∇·u)
Vec2 made_inside(const MovingPart& part, const Vector& u) {
  Vec2 made = Vec2::Zero();
  for (const MovingPart::Cell& cell : part.cells) {
    Eigen::Matrix<double, 6, 2> nodal;
    for (int i = 0; i < 6; ++i) nodal.row(i) = u.segment<2>(2 * cell.nodes[i]);
    const Eigen::Matrix<double, 6, 1> divergence =
        cell.slopes[0] * nodal.col(0) + cell.slopes[1] * nodal.col(1);
    made += nodal.transpose() * (cell.growth.head<6>() - divergence);
  }
  return made;
}

/// ∫u (u − w)·n over the surfaces, n out of the fluid, without what a body is said to let through.
Vec2 made_at_surfaces(const MovingPart& part, const Vector& u) {
  Vec2 made = Vec2::Zero();
  for (const MovingPart::SurfacePoint& point : part.surface) {
    const Vec2 at_x = value_at(point.nodes, point.shape, u);
    made += (point.normal.dot(at_x) - point.given) * at_x;
  }
  return made;
}

}  // namespace

void keep_momentum(double density, const std::vector<MovingPart>& parts, const Vector& u, Vector& residual) {
  for (const MovingPart& part : parts) {
    const Vec2 made = part.made + made_inside(part, u) + made_at_surfaces(part, u);
    const Vec2 force = density / part.area * made;
    for (const MovingPart::Cell& cell : part.cells)
      for (int i = 0; i < 6; ++i) residual.segment<2>(2 * cell.nodes[i]) -= cell.shape[i] * force;
  }
}

}  // namespace fpi::fluid
