/// Residual and exact Jacobian of the Navier–Stokes equations on an element, straight, curved or cut, by
/// quadrature (paper, eqs. 9, 11–13; numerics.md section 1 for the signs: dynamic pressure, momentum
/// multiplied by ρ). One kernel serves a single element (T = double) and several at once (T = Lanes).
#pragma once

#include <array>
#include <span>

#include "core/lanes.hpp"
#include "fluid/base/element.hpp"

namespace fpi::fluid {

/// Coefficients of the equations.
struct Flow {
  double density;    ///< ρ [kg/m³]
  double viscosity;  ///< μ [Pa s]
  double convection;  ///< factor of ρ (∇u)u: 1, or 0 for Stokes flow, or between on the way to a steady flow
  bool symmetric;     ///< 2μ ε(u):ε(w); else μ ∇u:∇w
};

/// Nodal values of an element, in the order of Mesh::cell_nodes.
template <class T>
struct ElementState {
  std::array<T, 6> ux, uy;  ///< u [m/s]
  std::array<T, 6> ax, ay;  ///< ∂u/∂t along the paths of the nodes [m/s²]
  std::array<T, 6> wx, wy;  ///< velocity of these paths [m/s]
  double inertia;           ///< ∂a/∂u = 1/(γ Δt) [1/s]; zero in steady flow
  std::array<T, 3> p;       ///< [Pa]
};

/// Local unknowns: ux 0–5, uy 6–11, p 12–14.
inline constexpr int element_unknowns = 15;
template <class T>
struct ElementSystem {
  std::array<T, element_unknowns> residual;
  std::array<T, element_unknowns * element_unknowns> jacobian;  ///< column by column
};

/// Overwrites the residual, and the Jacobian where `with_jacobian`. `metrics` holds one entry for all points
/// (straight sides) or one for each; a point weighs its weight times the metric's area.
template <class T>
void element_system(const Flow& flow, std::span<const ElementPoint> points,
                    std::span<const Metric<T>> metrics, const ElementState<T>& state,
                    ElementSystem<T>& system, bool with_jacobian);

extern template void element_system(const Flow&, std::span<const ElementPoint>,
                                    std::span<const Metric<double>>, const ElementState<double>&,
                                    ElementSystem<double>&, bool);
extern template void element_system(const Flow&, std::span<const ElementPoint>,
                                    std::span<const Metric<Lanes>>, const ElementState<Lanes>&,
                                    ElementSystem<Lanes>&, bool);

}  // namespace fpi::fluid
