#include "fluid/measure/resolution.hpp"

#include <algorithm>
#include <cmath>

namespace fpi::fluid {

void Resolution::include(const Resolution& other) {
  speed = std::max(speed, other.speed);
  if (other.cell_reynolds.value > cell_reynolds.value) cell_reynolds = other.cell_reynolds;
  if (other.courant.value > courant.value) courant = other.courant;
}

Resolution resolution(const Mesh& mesh, const std::vector<bool>& counts, const Vector& u,
                      double kinematic_viscosity, double time_step) {
  Resolution out;
  for (Index c = 0; c < mesh.n_cells(); ++c) {
    if (!counts.empty() && !counts[c]) continue;
    double squared = 0;
    for (const Index node : mesh.cell_nodes(c))
      squared = std::max(squared, u.segment<2>(2 * node).squaredNorm());
    if (squared == 0) continue;
    const double speed = std::sqrt(squared), h = mesh.size(c);
    const auto [a, b, d] = mesh.corners(c);
    const Vec2 centre = (a + b + d) / 3;
    out.include({speed, {speed * h / kinematic_viscosity, centre}, {speed * time_step / h, centre}});
  }
  return out;
}

}  // namespace fpi::fluid
