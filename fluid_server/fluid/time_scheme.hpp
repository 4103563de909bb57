/// Newmark's method (paper, eqs. 10–11), node by node: γ = 1 near bodies that move, the scene's γ elsewhere
/// (numerics.md section 2: γ = ½ amplifies what cuts do to the stored acceleration).
#pragma once

#include "fluid/cut_mesh.hpp"
#include "fluid/state.hpp"
#include "fluid/system.hpp"

namespace fpi::fluid {

/// a^{n+1} = (u^{n+1} − u^n)/(γ Δt) − (1 − γ)/γ a^n with γ of each node.
TimeTerms newmark(const Vector& u, const Vector& acceleration, double time_step, const Vector& gamma);

/// The velocity after the next step without solving for it: u + Δt a + ½ Δt²/Δt_previous (a − a_previous),
/// Adams and Bashforth's second order, or as much of it as the state's history allows.
Vector predicted_velocity(const State& state, double time_step);

/// Error of a step in time, relative to the velocity, from its distance to the prediction (P. M. Gresho, R.
/// L. Lee, R. L. Sani, On the time-dependent solution of the incompressible Navier–Stokes equations, 1980).
struct TimeError {
  double relative = 0;  ///< 0: the history is too short to tell
  int power = 0;        ///< of Δt that the error of a step goes with
};
TimeError time_error(const State& start, const Vector& u, double time_step, const Vector& gamma);

/// 1 on the nodes of cut and deactivated elements and of their neighbours, `gamma` elsewhere.
Vector gamma_of_nodes(const Mesh& mesh, const CutMesh& cut, double gamma);

}  // namespace fpi::fluid
