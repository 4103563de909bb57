#include "fluid/resolution.hpp"

#include <algorithm>

#include "fluid/navier_stokes.hpp"

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

/// Sudden starts, ramps and pulses: boundaries are asked at times all over the run.
Resolution NavierStokes::given_resolution(double end, double time_step) const {
  constexpr int samples = 16;
  const double viscosity = flow_.viscosity / flow_.density;
  Resolution out = fluid::resolution(space_.mesh, {}, accepted_.u, viscosity, time_step);
  Vector u = Vector::Zero(accepted_.u.size());
  for (int k = 0; k <= samples; ++k) {
    space_.boundary.impose(accepted_.time + (end - accepted_.time) * k / samples, u);
    out.include(fluid::resolution(space_.mesh, {}, u, viscosity, time_step));
    if (end == accepted_.time) break;
  }
  return out;
}

Resolution NavierStokes::resolution() const {
  return fluid::resolution(space_.mesh, active_cells(), accepted_.u, flow_.viscosity / flow_.density,
                           accepted_.previous_step);
}

}  // namespace fpi::fluid
