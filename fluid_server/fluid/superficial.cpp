#include "fluid/superficial.hpp"

namespace fpi::fluid {
namespace {

/// ∫u over what the points of a cell stand for; curved points integrate whole cells, straight or not.
Vec2 integral(const Mesh& mesh, Index cell, std::span<const ElementPoint> points, bool weights_have_area,
              const Vector& u) {
  const auto nodes = mesh.cell_nodes(cell);
  const CellNodes places = mesh.cell_places(cell);
  Vec2 sum = Vec2::Zero();
  for (const ElementPoint& point : points) {
    const double w = point.weight * (weights_have_area ? 1 : metric_at(places, point.shape).area);
    for (int i = 0; i < 6; ++i) sum += w * point.shape.n[i] * u.segment<2>(2 * nodes[i]);
  }
  return sum;
}

}  // namespace

Vec2 superficial_velocity(const Mesh& mesh, const CutMesh& cut, const Vector& u) {
  Vec2 sum = Vec2::Zero();
  for (Index c = 0; c < mesh.n_cells(); ++c)
    if (cut.state[c] == CellState::fluid) sum += integral(mesh, c, curved_points(), false, u);
  for (const auto& cut_cell : cut.cut_cells) sum += integral(mesh, cut_cell->cell, cut_cell->points, true, u);
  return sum / mesh.box_area();
}

}  // namespace fpi::fluid
