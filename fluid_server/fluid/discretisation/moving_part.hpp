/// A part of the mesh that moves with bodies, and what the discrete equations make of momentum there
/// (docs/numerics.md, "Momentum").
#pragma once

#include <vector>

#include "fluid/base/element.hpp"

namespace fpi::fluid {

/// Integrals over the cells of a part and along the surfaces in it, of one step.
struct MovingPart {
  using Square = Eigen::Matrix<double, 6, 6>;
  struct Cell {
    std::array<Index, 6> nodes;
    Padded shape;                  ///< ∫N_i [m²]
    Padded growth;                 ///< ∫N_i ∇·w [m²/s]
    std::array<Square, 2> slopes;  ///< ∫N_i ∂N_j/∂x and /∂y [m]
  };
  struct SurfacePoint {
    std::array<Index, 6> nodes;
    Padded shape;
    Vec2 normal;   ///< out of the fluid, times the point's weight [m]
    double given;  ///< what is to pass there, n·w and what the body lets through [m²/s]
  };
  std::vector<Cell> cells;
  std::vector<SurfacePoint> surface;
  double area = 0;           ///< of the fluid [m²]
  Vec2 made = Vec2::Zero();  ///< momentum that the history makes, over ρ Δt [m³/s²]
};

/// Takes what convection and inertia make of momentum [N/m] out of the residual of the nodes;
/// `density` ρ [kg/m³].
void keep_momentum(double density, const std::vector<MovingPart>& parts, const Vector& u, Vector& residual);

}  // namespace fpi::fluid
