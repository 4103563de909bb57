/// Residual and exact Jacobian of the Navier–Stokes equations on one element, cut or not, by quadrature
/// (paper, eqs. 9, 11–13; numerics.md section 1 for the signs: dynamic pressure, momentum multiplied by ρ).
#pragma once

#include <array>
#include <span>

#include "fluid/element.hpp"

namespace fpi::fluid {

/// Coefficients of the equations.
struct Flow {
  double density;    ///< ρ [kg/m³]
  double viscosity;  ///< μ [Pa s]
  bool convection;   ///< ρ (∇u)u is there
  bool symmetric;    ///< 2μ ε(u):ε(w); else μ ∇u:∇w
};

/// Nodal values of an element, in the order of Mesh::cell_nodes.
struct ElementState {
  Padded ux, uy;            ///< u [m/s]
  Padded ax, ay;            ///< ∂u/∂t [m/s²]
  Padded inertia;           ///< ∂a/∂u = 1/(γ Δt) of each node [1/s]; zero in steady flow
  std::array<double, 3> p;  ///< [Pa]
};

/// Local unknowns: ux 0–5, uy 6–11, p 12–14. Padded rows 6 and 7 of a block are not used.
struct ElementResidual {
  Padded x, y;              ///< momentum, against each N_i
  std::array<double, 3> q;  ///< continuity, against each L_k
};
struct ElementJacobian {
  using Block = Eigen::Matrix<double, 8, 6>;
  Block xx, xy, yx, yy;
  std::array<Padded, 3> xp, yp;  ///< columns of the gradient; the continuity rows are their transpose
};

/// Adds nothing: `residual` (and `jacobian` where it is not null) are overwritten. Weights of `points` are
/// multiplied by `scale` (the area for the standard points, 1 for points of a cut element).
void element_system(const Flow& flow, const Triangle& triangle, std::span<const ElementPoint> points,
                    double scale, const ElementState& state, ElementResidual& residual,
                    ElementJacobian* jacobian);

}  // namespace fpi::fluid
