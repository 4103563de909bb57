/// The first step without its solution: all that it would refuse.
#include "fluid/navier_stokes.hpp"

namespace fpi::fluid {
namespace {

/// As after a solution, where the continuity equation that a pinned pressure leaves out has what comes in as
/// its residual. Bodies that the fluid moves have the velocities that they are expected to have.
void check_parts(const System& system, const Vector& u) {
  const std::vector<PartInflow> parts = inflow_of_parts(system, u);
  Residual residual = system.no_residual();
  for (Index part = 0; part < static_cast<Index>(parts.size()); ++part)
    residual.p[system.components().pin(system.space().mesh, part)] = parts[part].net;
  system.check_closed_parts(residual, u);
}

}  // namespace

/// At which the first step asks formulas, its end last.
std::vector<double> NavierStokes::times_asked_for(const Request& request) const {
  const bool starts_consistently =
      request.time_step > 0 && settings_.fluid.newmark_gamma < 1 && !settings_.bodies_move;
  if (!starts_consistently) return {request.time};
  return {accepted_.time, request.time - 0.5 * request.time_step, request.time};
}

Findings NavierStokes::rehearse(const Request& request) {
  restore();  // the geometry of a step under way does not stay
  Findings findings;
  if (!findings.attempt("bodies", [&] { check(request.interfaces); })) return findings;
  std::shared_ptr<System> system;
  const bool is_made = findings.attempt("bodies", [&] {
    system = std::make_shared<System>(space_, settings_.fluid, with_fluid_loads(request), CutMesh{},
                                      monitor.timers);
  });
  Vector u = accepted_.u;
  for (const double t : times_asked_for(request)) {
    const bool is_finite = findings.attempt("fluid.boundaries", [&] { space_.boundary.impose(t, u); }) &&
                           (!is_made || findings.attempt("fluid", [&] { system->set_load(t, body_force_); }));
    if (!is_finite) return findings;
  }
  if (findings.attempt("fluid.boundaries", [&] { space_.boundary.check_net_flux(request.time, u); }))
    if (const std::string doubt = space_.boundary.doubtful_net_flux(request.time, u); !doubt.empty())
      findings.warn("fluid.boundaries", "{}", doubt);
  if (!is_made) return findings;
  system_ = system;
  findings.attempt("fluid", [&] { check_held(request.time_step == 0); });
  if (!findings.has_errors()) findings.attempt("fluid.boundaries", [&] { check_parts(*system, u); });
  system_.reset();
  return findings;
}

}  // namespace fpi::fluid
