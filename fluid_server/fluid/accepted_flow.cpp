/// What can be asked of the flow as it was last accepted.
#include <algorithm>

#include "core/error.hpp"
#include "fluid/mesh/periodic_mesh.hpp"
#include "fluid/mesh/sample.hpp"
#include "fluid/navier_stokes.hpp"

namespace fpi::fluid {

std::vector<bool> NavierStokes::active_cells() const {
  std::vector<bool> active(space_.mesh.n_cells(), true);
  if (accepted_system_)
    for (Index c = 0; c < space_.mesh.n_cells(); ++c) active[c] = accepted_system_->cut().is_active(c);
  return active;
}

Vector NavierStokes::velocity_with_bodies() const {
  Vector u = accepted_.u;
  if (accepted_system_)
    for (const CoveredNode& covered : accepted_system_->cut().covered)
      u.segment<2>(2 * covered.node) = body_velocity(covered);
  spread_to_copies(space_.mesh, 2, u);
  return u;
}

std::optional<std::pair<Vec2, double>> NavierStokes::at(const Vec2& x) const {
  const std::optional<Place> place = space_.locator.find(x);
  const Vec2 wrapped = space_.mesh.period.wrapped(x);
  if (!place || (accepted_system_ && !accepted_system_->cut().is_active(place->cell))) return std::nullopt;
  if (accepted_system_)
    for (const Image& image :
         accepted_system_->cut().images)  // a point on the surface itself is in the fluid
      if (image.surface().distance(wrapped) < -1e-6 * std::sqrt(image.surface().area())) return std::nullopt;
  const Sample here(space_.mesh, *place);
  return std::pair{here.velocity(accepted_.u), here.pressure(accepted_.p)};
}

FlowErrors NavierStokes::errors(const ExactFlow& exact) const {
  const bool closed = boundary_recovery_.curves().size() == space_.mesh.boundary_names.size();
  return flow_errors(space_.mesh,
                     accepted_system_ ? accepted_system_->cut() : cut_mesh(space_.mesh, space_.locator, {}),
                     accepted_, exact, closed);
}

PoreFlow NavierStokes::pore_flow() const {
  require(accepted_system_ != nullptr, "the flow in the pores is known after a step; none was accepted yet");
  return fluid::pore_flow(*accepted_system_, accepted_.u);
}

Vec2 NavierStokes::superficial_velocity() const { return pore_flow().superficial_velocity(); }

std::vector<Section> NavierStokes::sections(int axis, int n) const {
  if (!accepted_system_) return {};
  const double drop = mean_fall()[axis];
  return fluid::sections(*accepted_system_, accepted_.u, accepted_.p, axis, n, drop);
}

std::vector<SpeedBin> NavierStokes::speed_histogram(int axis, int n) const {
  if (!accepted_system_) return {};
  return fluid::speed_histogram(*accepted_system_, accepted_.u, axis, n);
}

std::size_t NavierStokes::n_closed_parts() const {
  return accepted_system_ ? accepted_system_->numbering().pinned.size() : 0;
}

/// Given and found.
Vec2 NavierStokes::mean_fall() const {
  return body_force_.pressure_drop(accepted_.time) +
         accepted_system_->drives().pressure_drop(accepted_drive_);
}

/// Along an axis that is not periodic the forces at its two ends say it: they hold the pressures there.
std::optional<double> NavierStokes::pressure_fall(int axis) {
  if (!accepted_system_) return std::nullopt;
  if (space_.mesh.period.along[axis]) return mean_fall()[axis];
  const auto balance = force_balance();
  if (!balance) return std::nullopt;
  const std::array<std::string, 2> ends = axis == 0
                                              ? std::array<std::string, 2>{"boundary:left", "boundary:right"}
                                              : std::array<std::string, 2>{"boundary:bottom", "boundary:top"};
  double force = 0;
  for (const std::string& end : ends) {
    const auto term = std::ranges::find(balance->terms, end, &ForceBalance::Term::name);
    if (term == balance->terms.end()) return std::nullopt;
    force += term->force[axis];
  }
  return force / space_.mesh.box().area();
}

/// A steady Stokes flow has just had the factor that this takes.
Eigen::Matrix2d NavierStokes::permeability() {
  if (!accepted_system_) return Eigen::Matrix2d::Zero();
  System& system = *accepted_system_;
  const Corrector& last = current_.corrector;
  const bool has_factor = !last_ && last.factor && last.is_exact && flow_.convection == 0 &&
                          time_terms_.inertia == 0 && system.drives().size() == 0;
  if (has_factor) return fluid::permeability(system, *last.factor, flow_.viscosity);
  Flow creeping = flow_;
  creeping.convection = 0;
  const auto [u, p, lambda, rigid, drive] = system.no_residual();
  system.assemble(creeping, {u, p, lambda, rigid, drive}, TimeTerms::steady(space_.mesh.n_nodes()), true);
  return fluid::permeability(system, *system.factor_of_matrix(monitor.timers), flow_.viscosity);
}

std::optional<ForceBalance> NavierStokes::force_balance() {
  if (!accepted_system_ || last_) return std::nullopt;
  const Vec2 mean = mean_force(accepted_.time) + system_->drives().pressure_drop(current_.fields.drive);
  return fluid::force_balance(*system_, flow_, current_.fields, time_terms_, accepted_.time, mean,
                              boundary_curves(), boundary_tractions_);
}

std::optional<VolumeBalance> NavierStokes::volume_balance() const {
  if (!accepted_system_ || last_) return std::nullopt;
  return fluid::volume_balance(*accepted_system_, current_.fields.u);
}

std::map<std::string, double> NavierStokes::found_drives() const {
  std::map<std::string, double> out;
  if (!accepted_system_) return out;
  for (Index k = 0; k < accepted_system_->drives().size(); ++k)
    out[accepted_system_->drives().all()[k].name] = accepted_drive_[k];
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

/// What elements make of the flow inside bodies is no flow.
Resolution NavierStokes::resolution() const {
  return fluid::resolution(space_.mesh, active_cells(), velocity_with_bodies(),
                           flow_.viscosity / flow_.density, accepted_.previous_step);
}

}  // namespace fpi::fluid
