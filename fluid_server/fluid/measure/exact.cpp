#include "fluid/measure/exact.hpp"

#include <algorithm>
#include <map>

#include "fluid/base/quadrature.hpp"

namespace fpi::fluid {
namespace {

/// Gauss points of the unit square folded into the triangle: exact to degree 8, which the squares of errors
/// need. Weights add up to 1.
const std::vector<ElementPoint>& folded_points() {
  static const std::vector<ElementPoint> points = [] {
    std::vector<ElementPoint> out;
    for (const LinePoint& a : gauss_legendre(6))
      for (const LinePoint& b : gauss_legendre(6)) {
        const double l1 = (1 - a.s) * b.s;
        out.push_back({shape_at({1 - a.s - l1, l1, a.s}), 2 * (1 - a.s) * a.weight * b.weight});
      }
    return out;
  }();
  return points;
}

Eigen::Matrix2d gradient_of(const ExactFlow& exact, const Vec2& x, double step) {
  Eigen::Matrix2d out;
  for (int k = 0; k < 2; ++k) {
    const Vec2 shift = step * Vec2::Unit(k);
    out.col(k) = (exact.velocity(x + shift) - exact.velocity(x - shift)) / (2 * step);
  }
  return out;
}

struct Sums {
  double velocity = 0, gradient = 0, pressure = 0, level = 0, area = 0;
};

}  // namespace

FlowErrors flow_errors(const Mesh& mesh, const CutMesh& cut, const State& state, const ExactFlow& exact,
                       bool without_level) {
  std::map<Index, const CutCell*> cut_cells;
  for (const auto& cell : cut.cut_cells) cut_cells[cell->cell] = cell.get();
  Sums sums;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!cut.is_active(c)) continue;
    const auto found = cut_cells.find(c);
    const bool is_cut = found != cut_cells.end();
    const auto nodes = mesh.cell_nodes(c);
    const CellNodes places = mesh.cell_places(c);
    for (const ElementPoint& point : is_cut ? found->second->points : folded_points()) {
      const Metric<double> metric = metric_at(places, point.shape);
      const Vec2 x = position_at(places, point.shape.n);
      const double w = is_cut ? point.weight : point.weight * metric.area;
      Vec2 velocity = -exact.velocity(x);
      Eigen::Matrix2d gradient = -gradient_of(exact, x, 1e-4 * mesh.size(c));
      double pressure = -exact.pressure(x);
      for (int i = 0; i < 6; ++i) {
        const Vec2 nodal = state.u.segment<2>(2 * nodes[i]);
        velocity += point.shape.n[i] * nodal;
        for (int k = 0; k < 3; ++k)
          gradient += point.shape.dn[k][i] * nodal * Eigen::RowVector2d(metric.gx[k], metric.gy[k]);
      }
      for (int i = 0; i < 3; ++i) pressure += point.shape.l[i] * state.p[nodes[i]];
      sums.velocity += w * velocity.squaredNorm();
      sums.gradient += w * gradient.squaredNorm();
      sums.pressure += w * pressure * pressure;
      sums.level += w * pressure;
      sums.area += w;
    }
  }
  const double level = without_level ? sums.level * sums.level / sums.area : 0;
  return {std::sqrt(sums.velocity), std::sqrt(sums.gradient),
          std::sqrt(std::max(0.0, sums.pressure - level))};
}

}  // namespace fpi::fluid
