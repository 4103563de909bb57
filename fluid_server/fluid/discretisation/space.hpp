/// All that stays as it is for a whole run: mesh, element geometry, search grid and boundary conditions.
#pragma once

#include "fluid/base/element.hpp"
#include "fluid/discretisation/boundary.hpp"
#include "fluid/mesh/colouring.hpp"
#include "fluid/mesh/locator.hpp"
#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// Points of an element with its geometry there: one metric for all of them, or one for each.
struct Quadrature {
  std::span<const ElementPoint> points;
  std::span<const Metric<double>> metrics;

  /// Weight of point q [m²].
  double weight(std::size_t q) const { return points[q].weight * metric(q).area; }
  const Metric<double>& metric(std::size_t q) const { return metrics[metrics.size() == 1 ? 0 : q]; }
};

struct Space {
  Mesh mesh;
  Locator locator;
  Boundary boundary;
  Colouring colouring;
  std::vector<Triangle> triangles;      ///< through the corners of each cell
  std::vector<Metric<double>> metrics;  ///< of these triangles
  double smallest_size;                 ///< h of the smallest element [m]

  Space(Mesh mesh_in, const std::map<std::string, scene::Boundary>& conditions);
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;

  /// Over the whole cell, straight or curved.
  Quadrature quadrature(Index cell) const {
    if (curved_index_[cell] < 0) return {standard_points(), {&metrics[cell], 1}};
    return {curved_points(), curved_metrics_[curved_index_[cell]]};
  }

 private:
  std::vector<Index> curved_index_;                          // of each cell, −1 where it is straight
  std::vector<std::vector<Metric<double>>> curved_metrics_;  // at curved_points()
};

}  // namespace fpi::fluid
