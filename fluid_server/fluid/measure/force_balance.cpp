#include "fluid/measure/force_balance.hpp"

#include <algorithm>

namespace fpi::fluid {
namespace {

/// Sum over all nodes: a residual or load for a uniform test velocity.
Vec2 total(const Vector& nodal) { return nodal.reshaped(2, nodal.size() / 2).rowwise().sum(); }

}  // namespace

Vec2 ForceBalance::rest() const {
  Vec2 sum = Vec2::Zero();
  for (const Term& term : terms) sum += term.force;
  return sum;
}

double ForceBalance::relative() const {
  double largest = 0;
  for (const Term& term : terms) largest = std::max(largest, term.force.norm());
  return largest > 0 ? rest().norm() / largest : 0;
}

ForceBalance force_balance(System& system, const Flow& flow, const Fields& fields, const TimeTerms& time,
                           double t, const Vec2& mean_force, const std::vector<BoundaryCurve>& curves,
                           const std::vector<BoundaryTraction>& held) {
  const Space& space = system.space();
  const std::vector<Surface> bodies = surfaces(system.cut().images);
  ForceBalance out;
  for (std::size_t c = 0; c < curves.size(); ++c)
    out.terms.push_back({"boundary:" + curves[c].name, -held[c].force});
  Vec2 given = Vec2::Zero();
  for (Index b = 0; b < static_cast<Index>(space.mesh.boundary_names.size()); ++b) {
    if (!space.boundary.is_open(b)) continue;
    const std::string& name = space.mesh.boundary_names[b];
    const Vec2 force = space.boundary.traction_force(b, t, {bodies, system.components().of_boundary});
    given += force;
    out.terms.push_back({"boundary:" + name, force + system.drives().force_at(name, fields.drive)});
  }
  Vec2 on_bodies = Vec2::Zero(), displaced = Vec2::Zero();
  for (const System::Resultant& resultant : system.resultants(fields.lambda)) on_bodies += resultant.force;
  for (const Interface& interface : system.interfaces()) displaced += interface.surface.area() * mean_force;
  out.terms.push_back({"bodies", -on_bodies - displaced});

  Flow creeping = flow;
  creeping.convection = 0;
  const Vec2 all = total(system.assemble(flow, fields, time, false).u);
  const TimeTerms steady = TimeTerms::steady(space.mesh.n_nodes());
  const Vec2 without_inertia = total(system.assemble(creeping, fields, steady, false).u);
  const Vec2 force_density = total(system.load()) - given + system.drives().force_density(fields.drive);
  out.terms.push_back({"body_force", force_density + displaced});
  out.terms.push_back({"momentum", without_inertia - all});
  return out;
}

}  // namespace fpi::fluid
