/// Newmark's method (paper, eqs. 10–11), node by node: γ = 1 near bodies that move, the scene's γ elsewhere
/// (numerics.md section 2: γ = ½ amplifies what cuts do to the stored acceleration).
#pragma once

#include "fluid/cut_mesh.hpp"
#include "fluid/system.hpp"

namespace fpi::fluid {

/// a^{n+1} = (u^{n+1} − u^n)/(γ Δt) − (1 − γ)/γ a^n with γ of each node.
TimeTerms newmark(const Vector& u, const Vector& acceleration, double time_step, const Vector& gamma);

/// 1 on the nodes of cut and deactivated elements and of their neighbours, `gamma` elsewhere.
Vector gamma_of_nodes(const Mesh& mesh, const CutMesh& cut, double gamma);

}  // namespace fpi::fluid
