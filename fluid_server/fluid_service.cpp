#include "fluid_service.hpp"

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "core/log.hpp"
#include "fluid/cut/intersected_cells.hpp"
#include "fluid/discretisation/scene_mesh.hpp"
#include "grains/expand.hpp"
#include "measurements.hpp"
#include "percolation_report.hpp"

namespace fpi::fluid {
namespace {

Vec2 to_plane(const proto::Vec3& v) { return {v[0], v[1]}; }
proto::Vec3 to_wire(const Vec2& v) { return {v.x(), v.y(), 0}; }

void check_dimension(const scene::Scene& scene, Findings& findings) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (const scene::Body& body = scene.bodies[b]; !body.is_plane())
      findings.error(fmt::format("bodies.{}.shape", b),
                     "bodies \"{}\": a plane fluid takes discs and polygons only; got a {}: make it one of "
                     "them",
                     body.name, body.shape);
}

Settings settings(const scene::Scene& scene) {
  return {*scene.fluid, Vec2(scene.gravity[0], scene.gravity[1]), scene.moves()};
}

/// Per metre of thickness.
Balance read_balance(const proto::Balance& m, double time_step, double thickness) {
  const double per_step = 1 / (time_step * thickness);
  return {.mass_rate = per_step * m.mass,
          .inertia_rate = per_step * m.inertia,
          .load = per_step * m.mass * to_plane(m.velocity) + to_plane(m.force) / thickness,
          .torque = per_step * m.inertia * m.spin[2] + m.torque[2] / thickness};
}

Interface read_interface(const proto::Interface& m, double time_step, double thickness) {
  Interface out;
  out.body = static_cast<Index>(m.body);
  out.rigid = {to_plane(m.centre), to_plane(m.translation), m.spin[2]};
  if (!m.rigid) out.sampled = to_points(m.velocities);
  if (m.radius > 0) {
    out.surface = Disc{out.rigid.centre, m.radius};
    out.start = m.start;
    out.end = m.end;
  } else {
    set_edges(out, to_points(m.vertices));
  }
  if (m.balance) out.balance = read_balance(*m.balance, time_step, thickness);
  return out;
}

proto::Traction write_traction(const BodyTraction& t, double thickness) {
  proto::Traction out{.body = static_cast<std::uint32_t>(t.body),
                      .force = to_wire(thickness * t.force),
                      .torque = {0, 0, thickness * t.torque},
                      .arc_length = t.arc_length,
                      .velocity = to_wire(t.motion.translation),
                      .spin = {0, 0, t.motion.spin},
                      .mean_force = to_wire(thickness * t.mean.force),
                      .mean_torque = proto::Vec3{0, 0, thickness * t.mean.torque}};
  for (const Vec2& lambda : t.lambda) out.values.insert(out.values.end(), {lambda.x(), lambda.y()});
  return out;
}

/// Of the first body that has a part outside the mesh, and what would stop it; empty where none has.
std::string body_outside(const scene::Scene& scene, const NavierStokes& solver, const Request& request) {
  constexpr int places = 64;  // of each surface
  for (const Interface& interface : request.interfaces)
    for (int k = 0; k < places; ++k) {
      const Vec2 x = interface.surface.at(interface.surface.period() * k / places);
      if (solver.has(x)) continue;
      return fmt::format(
          "body \"{}\" reaches out of the mesh at ({:.4g}, {:.4g}) m: stop it with one of [[walls]], or let "
          "it leave where the boundary is open by [[outlets]]",
          scene.bodies.at(static_cast<std::size_t>(interface.body)).name, x.x(), x.y());
    }
  return "";
}

/// A flow that cannot be may be so because a body leaves where nothing can follow it.
Result solve(const scene::Scene& scene, NavierStokes& solver, const Request& request) {
  try {
    return solver.advance(request);
  } catch (const Error& error) {
    const std::string outside = body_outside(scene, solver, request);
    if (outside.empty()) throw;
    fail("{}; {}", outside, error.what());
  }
}

}  // namespace

proto::Configured FluidService::configure(const proto::Configure& message) {
  progress.set("mesh");
  Timers timers;
  Findings findings;
  {
    const ScopedTimer timer(timers, "mesh");
    scene_ = scene::read_text(message.scene, "the scene sent by the coupler");
    require(scene_.fluid.has_value(),
            "a scene with [fluid] is required; got one without: start no fluid for it");
    grains::expand(scene_, [&](const std::string& name) { return proto::content(message.files, name); });
    check_dimension(scene_, findings);
    make_solver(message.files, findings);
  }
  if (!solver_) return {.findings = findings.all()};
  solver_->monitor.timers = std::move(timers);
  solver_->monitor.phase = [this](const char* phase) { progress.set(phase); };
  const Mesh& mesh = solver_->mesh();
  if (!message.state.empty())
    solver_->set_state(from_bytes(message.state, mesh.n_nodes(), mesh.n_vertices()));

  // A gap of one element is resolved, whatever the arcs' length beside it.
  proto::Configured out{.arc_lengths = arc_lengths(mesh, solver_->locator(), findings),
                        .resolved_gap_ratio = 1 / scene_.fluid->embedding.arc_ratio,
                        .notes = solver_->notes()};
  resolution_.begin(scene_, *solver_, findings);
  out.figures = resolution_.figures();
  out.findings = findings.all();
  return out;
}

/// Where the mesh and its boundaries are as the scene has them; what else is wrong with the scene's places in
/// the mesh is told with it.
void FluidService::make_solver(const std::vector<proto::File>& files, Findings& findings) {
  const scene::Fluid& fluid = *scene_.fluid;
  std::optional<Mesh> mesh;
  findings.attempt(fluid.mesh.file.empty() ? "fluid.mesh" : "fluid.mesh.file", [&] {
    const std::string_view text = fluid.mesh.file.empty() ? "" : proto::content(files, fluid.mesh.file);
    mesh = scene_mesh(fluid, scene_.periodic, text);
  });
  if (!mesh) return;
  const Findings boundaries = unmatched(*mesh, fluid.boundaries);
  findings.append(boundaries.all());
  if (!findings.has_errors())
    findings.attempt("fluid", [&] { solver_.emplace(std::move(*mesh), settings(scene_)); });
  if (solver_) return check_places(scene_, solver_->mesh(), solver_->locator(), findings);
  if (mesh->cells.empty()) return;  // it was taken
  const Locator locator(*mesh);
  check_places(scene_, *mesh, locator, findings);
  arc_lengths(*mesh, locator, findings);
}

std::vector<proto::ArcLength> FluidService::arc_lengths(const Mesh& mesh, const Locator& locator,
                                                        Findings& findings) const {
  std::vector<proto::ArcLength> lengths;
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const scene::Body& body = scene_.bodies[b];
    if (!body.is_plane()) continue;
    const double length = wanted_arc_length(mesh, locator, surface(body, scene_.hydraulic_radius_ratio),
                                            scene_.fluid->embedding.arc_ratio);
    if (!(length > 0))
      findings.error(fmt::format("bodies.{}.position", b),
                     "the body \"{}\" must lie in the mesh; its surface around ({:g}, {:g}) m meets no "
                     "element: move it inside, or make the mesh larger",
                     body.name, body.position[0], body.position[1]);
    else
      lengths.push_back({static_cast<std::uint32_t>(b), length});
  }
  return lengths;
}

proto::FluidAdvanced FluidService::advance(const proto::Stamp& stamp, const proto::FluidAdvance& message) {
  Request request{message.time, message.time_step, stamp.sub_iteration, {}, message.wants_resistance};
  for (const proto::Interface& interface : message.interfaces)
    request.interfaces.push_back(read_interface(interface, message.time_step, scene_.thickness));
  if (message.rehearsal) return {.findings = solver().rehearse(request).all()};
  const Result result = solve(scene_, solver(), request);
  proto::FluidAdvanced out{.converged = result.newton.converged,
                           .reason = result.newton.reason,
                           .newton_iterations = static_cast<std::uint32_t>(result.newton.iterations),
                           .residual = result.newton.update,
                           .time_error = result.time_error.relative,
                           .time_error_order = static_cast<double>(result.time_error.power)};
  for (const BodyTraction& traction : result.tractions)
    out.tractions.push_back(write_traction(traction, scene_.thickness));
  out.speed = result.speed;
  const auto resistance = (scene_.thickness * result.resistance).reshaped<Eigen::RowMajor>();
  out.resistance.assign(resistance.begin(), resistance.end());
  return out;
}

/// Bodies that leave are not among the interfaces of the next step, which is all that the flow needs.
proto::Accepted FluidService::accept(const proto::Accept&) {
  solver().accept();
  permeability_ = permeability_figures(scene_, solver());
  return {step_figures(scene_, solver()), resolution_.accept(solver())};
}

void FluidService::restore() { solver().restore(); }

proto::Fields FluidService::write(const proto::Write& message) {
  const Mesh& mesh = solver().mesh();
  const State& state = solver().state();
  proto::Fields out{.time = state.time};
  if (message.mesh) {
    for (Index n = 0; n < mesh.n_nodes(); ++n) {
      const Vec2 x = mesh.node_position(n);
      out.points.insert(out.points.end(), {x.x(), x.y(), 0});
    }
    for (Index c = 0; c < mesh.n_cells(); ++c)
      for (Index node : mesh.placed_nodes(c)) out.cells.push_back(static_cast<std::uint32_t>(node));
  }
  const Vector u = solver().velocity_with_bodies();
  proto::Field velocity{.name = "velocity", .components = 2, .values = {u.begin(), u.end()}};
  proto::Field pressure{.name = "pressure", .values = {state.p.begin(), state.p.end()}};
  for (const auto& [a, b] : mesh.edges) pressure.values.push_back(0.5 * (state.p[a] + state.p[b]));
  proto::Field active{.name = "active", .on_cells = true};
  for (const bool is_active : solver().active_cells()) active.values.push_back(is_active ? 1 : 0);
  out.fields = {std::move(velocity), std::move(pressure), std::move(active)};
  out.boundaries = boundary_curves(solver());
  out.profiles = profile_curves(scene_, solver());
  out.tables = percolation_tables(scene_, solver());
  return out;
}

proto::State FluidService::checkpoint() {
  solver().drop_caches();
  return {to_bytes(solver().state())};
}

proto::Figures FluidService::report() {
  if (!solver_) return {};
  proto::Figures figures = final_figures(scene_, *solver_);
  for (auto& figure : percolation_figures(scene_, *solver_)) figures.push_back(std::move(figure));
  figures.insert(figures.end(), permeability_.begin(), permeability_.end());
  if (const auto balance = solver_->force_balance()) {
    const proto::Figures terms = balance_figures(scene_.thickness, *balance);
    figures.insert(figures.end(), terms.begin(), terms.end());
    log::info("forces on the fluid add up to {:.2g} of the largest", balance->relative());
  }
  if (const auto balance = solver_->volume_balance())
    std::ranges::move(volume_figures(scene_.thickness, *balance), std::back_inserter(figures));
  for (const auto& [name, seconds] : solver_->monitor.timers.seconds)
    figures.emplace_back("seconds:" + name, seconds);
  for (const auto& [name, count] : solver_->monitor.timers.counts) figures.emplace_back(name, count);
  std::ranges::move(resolution_.figures(), std::back_inserter(figures));
  figures.emplace_back("unknowns", solver_->n_unknowns());
  return figures;
}

NavierStokes& FluidService::solver() {
  require(solver_.has_value(),
          "the fluid must be configured before it is asked for anything: send Configure first");
  return *solver_;
}

}  // namespace fpi::fluid
