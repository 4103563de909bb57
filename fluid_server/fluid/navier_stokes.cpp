#include "fluid/navier_stokes.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/log.hpp"
#include "fluid/linear/condition.hpp"
#include "fluid/mesh/periodic_mesh.hpp"
#include "fluid/solve/momentum_balance.hpp"
#include "fluid/solve/steady.hpp"

namespace fpi::fluid {
namespace {

Vector initial_velocity(const Mesh& mesh, const std::vector<std::string>& formulas) {
  const Expression x_formula(formulas[0], "fluid.initial_velocity.0");
  const Expression y_formula(formulas[1], "fluid.initial_velocity.1");
  Vector u(2 * mesh.n_nodes());
  for (Index node = 0; node < mesh.n_nodes(); ++node) {
    const Vec2 x = mesh.node_position(node);
    u.segment<2>(2 * node) = Vec2(x_formula(x.x(), x.y(), 0), y_formula(x.x(), x.y(), 0));
  }
  spread_to_copies(mesh, 2, u);
  return u;
}

}  // namespace

NavierStokes::NavierStokes(Mesh mesh, Settings settings)
    : settings_(std::move(settings)),
      flow_{settings_.fluid.density, settings_.fluid.viscosity(), settings_.fluid.convection ? 1.0 : 0.0,
            settings_.fluid.viscous_form == "symmetric"},
      body_force_(settings_.fluid),
      space_(std::move(mesh), settings_.fluid.boundaries),
      boundary_recovery_(space_.mesh, space_.boundary) {
  check_linear_solver(settings_.fluid.linear_solver);
  accepted_ = State::at_rest(space_.mesh.n_nodes(), space_.mesh.n_vertices());
  accepted_.u = initial_velocity(space_.mesh, settings_.fluid.initial_velocity);
  space_.boundary.impose(0, accepted_.u);
}

Result NavierStokes::advance(const Request& request) {
  require(request.time_step >= 0, "a time step ≥ 0 s is required; got {}", request.time_step);
  check(request.interfaces);
  const unsigned k = request.sub_iteration;
  require(
      request.time_step > 0 ||
          std::ranges::none_of(request.interfaces, [](const Interface& i) { return i.balance.has_value(); }),
      "a steady flow cannot move bodies: give their velocities");
  Result result;
  if (k == 0) {
    result.newton = start_step(request);
  } else {
    const bool follows = last_ && k == last_->sub_iteration + 1 && last_converged_;
    require(follows || (last_ && k == last_->sub_iteration),
            "sub-iteration {} must follow sub-iteration {}, which must have converged", k, k - 1);
    require(last_->time == request.time && last_->time_step == request.time_step &&
                system_->same_geometry(request.interfaces),
            "all sub-iterations of a step share its time and the place of the interfaces; sub-iteration {} "
            "differs",
            k);
    if (k == last_->sub_iteration + 1) base_ = current_;
    result.newton.converged = true;
  }
  last_ = request;
  last_converged_ = false;
  if (!result.newton.converged) return result;
  if (k > 0) system_->set_velocities(with_fluid_loads(request));
  result.newton = solve_step(request);
  if (result.newton.converged) {
    result.tractions = tractions();
    result.speed = system_->speed(current_.fields.u);
    if (request.wants_resistance && current_.corrector.reference)
      result.resistance = gamma(request) * system_->resistance(*current_.corrector.reference);
    if (request.time_step > 0)
      result.time_error =
          time_error(scheme_, start_, current_.fields.u, request.time_step, system_->wet_nodes());
  }
  last_converged_ = result.newton.converged;
  return result;
}

/// Geometry, time terms and the first guess of a step; not converged where no consistent start was found.
NewtonResult NavierStokes::start_step(const Request& request) {
  std::vector<Interface> interfaces = with_fluid_loads(request);
  if (accepted_system_ && accepted_system_->same_geometry(interfaces)) system_ = accepted_system_;
  if (system_ && system_->same_geometry(interfaces)) {
    system_->set_velocities(interfaces);
  } else {
    monitor.phase("interface");
    system_ = std::make_shared<System>(space_, settings_.fluid, std::move(interfaces),
                                       system_ ? system_->cut() : CutMesh{}, monitor.timers);
    require(!system_->active_cells().empty(),
            "some of the mesh must be left to the fluid; the bodies cover all of its {} elements",
            space_.mesh.n_cells());
  }
  system_->want_resistance(request.wants_resistance);
  if (!accepted_system_) check_held(request.time_step == 0);
  start_ = accepted_;
  if (settings_.bodies_move && !knows_past(request.time_step, start_.previous_step)) start_.forget_past();
  NewtonResult result;
  result.converged = true;
  if (request.time_step > 0 && !start_.has_acceleration && settings_.fluid.newmark_gamma < 1 &&
      !settings_.bodies_move)
    result = begin(request);
  set_time_terms(request);
  system_->set_load(request.time, body_force_);
  // A start from rest into a given inflow has an acceleration that no guess should follow for a whole step.
  const bool follow = start_.has_acceleration;
  base_.fields = with_multipliers(
      predicted_velocity(start_, request.time_step, follow ? best_order(start_) : 0), start_.p);
  if (start_.damped_steps > 0) return result;  // with the factor of the first half
  base_.corrector = kept_.lend(time_terms_.inertia, system_ == accepted_system_);
  if (time_terms_.moves()) base_.corrector.factor = nullptr;  // the mesh velocity is another one each step
  if (base_.corrector.reference && !system_->has_resistance(*base_.corrector.reference)) base_.corrector = {};
  return result;
}

/// From the accepted state.
Scheme NavierStokes::scheme_of_moving_bodies(double time_step) const {
  if (settings_.fluid.newmark_gamma == 1) return Scheme::newmark(time_step, 1);
  return Scheme::bdf2(time_step, accepted_.previous_step);
}

/// Stokes flow stays linear, one solution a step: there bodies carry momentum past the fluid anyway.
bool NavierStokes::keeps_momentum() const { return settings_.bodies_move && flow_.convection > 0; }

void NavierStokes::set_time_terms(const Request& request) {
  const double step = request.time_step, gamma = settings_.fluid.newmark_gamma;
  if (step == 0) {
    time_terms_ = TimeTerms::steady(space_.mesh.n_nodes());
  } else if (!settings_.bodies_move) {
    const bool second_half = start_.damped_steps > 0;  // of a damped step
    scheme_ = Scheme::newmark(second_half ? 0.5 * step : step, start_.has_acceleration ? gamma : 1);
    time_terms_ = time_terms(scheme_, start_);
  } else {
    monitor.phase("interface");
    const ScopedTimer timer(monitor.timers, "interface");
    scheme_ = scheme_of_moving_bodies(step);
    displacement_ = displacement(space_, request.interfaces, accepted_.places, step);
    if (displacement_.isZero(0) && accepted_.mesh_velocity.isZero(0)) {
      time_terms_ = time_terms(scheme_, start_);
    } else {
      start_ = along_paths(space_, displacement_, start_);
      time_terms_ = time_terms(scheme_, start_, displacement_);
      follow_paths(*system_, displacement_, accepted_, scheme_, time_terms_);
    }
    if (keeps_momentum())
      time_terms_.parts = moving_parts(*system_, displacement_, accepted_, scheme_, time_terms_);
  }
}

Fields NavierStokes::with_multipliers(const Vector& u, const Vector& p) const {
  const std::vector<Interface>& interfaces = system_->interfaces();
  Vector rigid(3 * static_cast<Eigen::Index>(interfaces.size()));
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    rigid.segment<3>(3 * static_cast<Eigen::Index>(i)) << interfaces[i].rigid.translation,
        interfaces[i].rigid.spin;
  return {u, p, Vector::Zero(2 * system_->cut().n_multipliers()), rigid,
          Vector::Zero(system_->drives().size())};
}

NewtonResult NavierStokes::solve_step(const Request& request) {
  current_ = base_;
  space_.boundary.impose(request.time, current_.fields.u);
  space_.boundary.check_net_flux(request.time, current_.fields.u);
  for (Index v : system_->numbering().pinned) current_.fields.p[v] = 0;
  const bool is_cold = request.time_step == 0 && request.sub_iteration == 0;
  const NewtonResult result =
      is_cold ? solve_steady(*system_, flow_, settings_.fluid.newton, current_, monitor)
              : solve(*system_, flow_, time_terms_, settings_.fluid.newton, current_, monitor);
  if (result.converged) system_->keep_motions(current_.fields.rigid);
  if (result.converged && request.sub_iteration == 0 && !system_->numbering().pinned.empty())
    system_->check_closed_parts(system_->assemble(flow_, current_.fields, time_terms_, false),
                                current_.fields.u);
  return result;
}

/// The mean pressure falls by this much a metre [Pa/m], in the place of a body too; λ does not know of it.
Vec2 NavierStokes::mean_force(double time) const {
  return body_force_.pressure_drop(time) - flow_.density * settings_.gravity;
}

/// The part of a step's mean load that is the load at its end; the rest is the mean load of the last step.
/// Bodies and fluid then exchange momentum by one formula, and what the surface gives to one it takes from
/// the other: what BDF2 makes of the fluid's past, a sudden start or an impact in it, it makes of the bodies'
/// too.
double NavierStokes::gamma(const Request& request) const {
  if (request.time_step == 0 || !settings_.bodies_move) return 1;
  return scheme_of_moving_bodies(request.time_step).gamma(request.time_step);
}

/// On a body over the last step; none where it was not there.
MeanLoad NavierStokes::load_before(Index body) const {
  const auto found = std::ranges::find(accepted_.loads, body, &MeanLoad::body);
  return found == accepted_.loads.end() ? MeanLoad{.body = body} : *found;
}

/// The interfaces asked for, their balances m (V − V_n)/Δt = G + γ F + (1 − γ) × last step's mean F divided
/// by γ, so that the multipliers keep their factor, and with what the mean pressure exerts.
std::vector<Interface> NavierStokes::with_fluid_loads(const Request& request) const {
  std::vector<Interface> interfaces = request.interfaces;
  const Vec2 force_density = mean_force(request.time);
  const double g = gamma(request);
  for (Interface& interface : interfaces) {
    if (!interface.balance) continue;
    Balance& balance = *interface.balance;
    const Vec2 buoyancy = interface.surface.area() * force_density;
    const MeanLoad before = load_before(interface.body);
    balance.mass_rate /= g;
    balance.inertia_rate /= g;
    balance.load = (balance.load + (1 - g) * before.force) / g + buoyancy;
    balance.torque = (balance.torque + (1 - g) * before.torque) / g +
                     cross(interface.surface.centroid() - interface.rigid.centre, buoyancy);
  }
  return interfaces;
}

std::vector<BodyTraction> NavierStokes::tractions() const {
  const auto resultants = system_->resultants(current_.fields.lambda);
  const auto& interfaces = system_->interfaces();
  const Vec2 force_density = mean_force(last_->time) + system_->drives().pressure_drop(current_.fields.drive);
  const double g = gamma(*last_);
  std::vector<BodyTraction> out(interfaces.size());
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const Interface& interface = interfaces[i];
    const MultiplierNodes& multiplier_nodes = system_->cut().multiplier_nodes[i];
    const auto lambda =
        current_.fields.lambda.segment(2 * system_->cut().first_multiplier[i], 2 * multiplier_nodes.size());
    out[i].body = interface.body;
    for (Index a = 0; a < interface.n_arcs(); ++a) {
      const auto [left, right] = multiplier_nodes.values(a);
      const auto hats = multiplier_nodes.hats(a, 0.5 * (interface.start[a] + interface.end[a]));
      out[i].lambda.emplace_back(hats[0] * lambda.segment<2>(2 * left) +
                                 hats[1] * lambda.segment<2>(2 * right));
    }
    const Surface& surface = interface.surface;
    const Vec2 buoyancy = surface.area() * force_density;
    out[i].motion = interface.rigid;
    out[i].force = resultants[i].force + buoyancy;
    out[i].torque = resultants[i].torque + cross(surface.centroid() - interface.rigid.centre, buoyancy);
    const MeanLoad before = load_before(interface.body);
    out[i].mean = {.body = interface.body,
                   .force = g * out[i].force + (1 - g) * before.force,
                   .torque = g * out[i].torque + (1 - g) * before.torque};
    out[i].arc_length = system_->arc_lengths()[i];
  }
  return out;
}

/// Velocity of the accepted body at a node that it covers.
Vec2 NavierStokes::body_velocity(const CoveredNode& covered) const {
  return accepted_interfaces_[covered.interface].rigid(space_.mesh.node_position(covered.node) -
                                                       covered.shift);
}

void NavierStokes::accept() {
  require(last_ && last_converged_, "accept must follow an advance that converged");
  const Fields& fields = current_.fields;
  measure_boundaries();
  accepted_tractions_ = tractions();
  accepted_.loads.clear();
  for (const BodyTraction& traction : accepted_tractions_) accepted_.loads.push_back(traction.mean);
  accepted_.time = last_->time;
  if (last_->time_step > 0)
    accepted_.prediction_errors =
        prediction_errors(start_, fields.u, last_->time_step, system_->numbering().node_is_active);
  accepted_.previous_acceleration = start_.acceleration;
  accepted_.has_previous_acceleration = start_.has_acceleration;
  accepted_.step_before = start_.previous_step;
  accepted_.previous_step = last_->time_step;
  accepted_.previous_u = std::move(accepted_.u);
  if (displacement_.size() > 0) accepted_.mesh_velocity = displacement_ / last_->time_step;
  accepted_.previous_fluid_in_cells = std::move(accepted_.fluid_in_cells);
  if (keeps_momentum()) accepted_.fluid_in_cells = fluid_in_cells(*system_, fields.u);
  accepted_.acceleration = time_terms_.acceleration(fields.u);
  accepted_.has_acceleration = last_->time_step > 0 && start_.damped_steps <= 0;
  accepted_.damped_steps = start_.damped_steps > 0 ? start_.damped_steps - 1 : start_.damped_steps;
  accepted_.u = fields.u;
  accepted_.p = fields.p;
  accepted_drive_ = fields.drive;
  accepted_interfaces_ = system_->interfaces();
  accepted_.places.clear();
  for (const Interface& interface : accepted_interfaces_) accepted_.places.push_back(place_of(interface));
  // What bodies cover moves with them; a path that grazes another body may ask.
  for (const CoveredNode& covered : system_->cut().covered) {
    if (system_->numbering().node_is_active[covered.node]) continue;
    accepted_.u.segment<2>(2 * covered.node) = body_velocity(covered);
    accepted_.acceleration.segment<2>(2 * covered.node).setZero();
  }
  for (Vector* field : {&accepted_.u, &accepted_.acceleration}) spread_to_copies(space_.mesh, 2, *field);
  spread_to_copies(space_.mesh, 1, accepted_.p);
  Corrector kept = current_.corrector;
  if (time_terms_.moves()) kept.factor = nullptr;
  // More than three sub-iterations: the resistance that bodies moved with no longer holds.
  constexpr unsigned many_sub_iterations = 3;
  if (system_->wants_resistance() && last_->sub_iteration >= many_sub_iterations)
    kept_.drop();
  else
    kept_.take(kept);
  accepted_system_ = system_;
  last_.reset();
}

void NavierStokes::restore() { last_.reset(); }

void NavierStokes::set_state(State state) {
  const auto fits_cells = [&](const Vector& in_cells) {
    return in_cells.size() == 0 || in_cells.size() == 3 * static_cast<Eigen::Index>(space_.mesh.n_cells());
  };
  require(state.u.size() == accepted_.u.size() && state.acceleration.size() == accepted_.u.size() &&
              state.p.size() == accepted_.p.size() && fits_cells(state.fluid_in_cells) &&
              fits_cells(state.previous_fluid_in_cells),
          "the state belongs to another mesh: resume with the scene that the run was started with");
  accepted_ = std::move(state);
  system_.reset();
  accepted_system_.reset();
  accepted_interfaces_.clear();
  boundary_tractions_.clear();
  last_.reset();
  kept_.drop();
  drop_caches();
}

void NavierStokes::drop_caches() {
  kept_.forget();
  base_.corrector = current_.corrector = {};
}

double NavierStokes::arc_length(const Surface& surface) const {
  return wanted_arc_length(space_.mesh, space_.locator, surface, settings_.fluid.embedding.arc_ratio);
}

double NavierStokes::condition() {
  require(system_ != nullptr, "a step is required before the condition of its matrix is known");
  return condition_estimate(system_->matrix(), *system_->factor_of_matrix(monitor.timers));
}

/// Where nothing holds the fluid along an axis, a steady flow has any velocity that way, or none.
void NavierStokes::check_held(bool steady) const {
  const auto direction = unheld_direction(space_.boundary, system_->numbering());
  if (!direction) return;
  const std::string nothing =
      fmt::format("nothing holds the fluid along ({:.3g}, {:.3g})", direction->x(), direction->y());
  require(!steady,
          "{}: a steady flow needs a wall, a body or a given velocity that does; add one, or solve in time",
          nothing);
  if (!body_force_.is_zero())
    log::warning("{}: the mean of the force on it makes it faster for ever", nothing);
}

/// The residual of the nodes that a boundary holds is what it does to the fluid, to the order of the scheme.
void NavierStokes::measure_boundaries() {
  if (boundary_recovery_.curves().empty()) return;
  monitor.timers.counts["residuals"] += 1;
  const ScopedTimer timer(monitor.timers, "assembly");
  const Residual residual = system_->assemble(flow_, current_.fields, time_terms_, false);
  boundary_tractions_ = boundary_recovery_.recover(-residual.u);
}

std::vector<std::string> NavierStokes::notes() const {
  std::vector<std::string> notes{fmt::format("a mesh of {} triangles, the smallest of {:.3g} m",
                                             space_.mesh.n_cells(), space_.smallest_size)};
  if (!flow_.convection) notes.emplace_back("no convection: each step is one linear problem");
  if (!settings_.bodies_move)
    notes.emplace_back("no body moves: the cut geometry and its ordering are found once");
  if (!flow_.convection && !settings_.bodies_move)
    notes.emplace_back("the matrix does not change: one factorisation serves every step of equal length");
  if (body_force_.is_zero()) notes.emplace_back("no body force: none is integrated");
  return notes;
}

}  // namespace fpi::fluid
