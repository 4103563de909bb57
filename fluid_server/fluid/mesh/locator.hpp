/// Which triangles are near a point or a box: a uniform grid of bins over the mesh, built once.
#pragma once

#include <optional>

#include "fluid/base/element.hpp"
#include "fluid/mesh/mesh.hpp"

namespace fpi::fluid {

/// A point of the mesh: its cell and the barycentric coordinates there.
struct Place {
  Index cell;
  Barycentric l;
};

class Locator {
 public:
  explicit Locator(const Mesh& mesh);

  /// Cells whose bounding box may overlap [lower, upper]; each once, ascending.
  std::vector<Index> near(const Vec2& lower, const Vec2& upper) const;

  /// Where x is, any number of periods away; nothing outside the mesh. Straight triangles hold what they hold
  /// to round-off, curved ones a little more, since a parabola is not quite the circle on which a point may
  /// have been asked for.
  std::optional<Place> find(const Vec2& x) const;

 private:
  int column(double x) const;
  int row(double y) const;

  const Mesh& mesh_;
  Vec2 lower_, upper_;
  double bin_ = 1;
  int n_x_ = 1, n_y_ = 1;
  std::vector<Index> first_, cells_;  // bin b holds cells_[first_[b]] … cells_[first_[b + 1] - 1]
};

}  // namespace fpi::fluid
