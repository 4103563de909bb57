/// The first step without its solution: all that it would refuse.
#include "fluid/navier_stokes.hpp"

namespace fpi::fluid {
namespace {

/// Where no open boundary is reached, what sides and bodies bring in must leave as well.
void check_parts(const System& system, const Vector& u, Findings& findings) {
  const std::vector<PartInflow> parts = inflow_of_parts(system, u);
  const double leak = 0.01 * system.smallest_size() * u.lpNorm<Eigen::Infinity>();
  double all = 0;
  for (const PartInflow& part : parts) all += part.gross;
  for (Index k = 0; k < static_cast<Index>(parts.size()); ++k) {
    const double net = parts[k].net;
    if (!parts[k].is_given || std::abs(net) <= 0.05 * all + leak) continue;
    const Mesh& mesh = system.space().mesh;
    const Vec2 x = mesh.vertices[system.components().pin(mesh, k)];
    findings.error(
        "fluid.boundaries",
        "where no open boundary is reached, as much fluid must enter as leaves; around ({:.4g}, "
        "{:.4g}) m a net {:.4g} m²/s {}: leave a way to an open boundary, or balance the velocities",
        x.x(), x.y(), std::abs(net), net < 0 ? "leaves" : "enters");
  }
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
  Findings findings;
  if (!findings.attempt("bodies", [&] { check(request.interfaces); })) return findings;
  std::shared_ptr<System> system;
  const bool is_made = findings.attempt("bodies", [&] {
    system =
        std::make_shared<System>(space_, settings_.fluid, with_buoyancy(request), CutMesh{}, monitor.ledger);
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
  if (!findings.has_errors()) check_parts(*system, u, findings);
  system_.reset();
  return findings;
}

}  // namespace fpi::fluid
