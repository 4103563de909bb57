#include "fluid_service.hpp"

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "core/log.hpp"
#include "fluid/scene_mesh.hpp"
#include "grains/expand.hpp"
#include "measurements.hpp"
#include "percolation_report.hpp"

namespace fpi::fluid {
namespace {

Vec2 to_plane(const proto::Vec3& v) { return {v[0], v[1]}; }
proto::Vec3 to_wire(const Vec2& v) { return {v.x(), v.y(), 0}; }

void check_dimension(const scene::Scene& scene) {
  for (const scene::Body& body : scene.bodies)
    require(body.is_plane(),
            "bodies \"{}\": a plane fluid takes discs and polygons only; got a {}: make it one of them",
            body.name, body.shape);
}

std::vector<Vec2> to_points(const std::vector<double>& coordinates) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2)
    points.emplace_back(coordinates[i], coordinates[i + 1]);
  return points;
}

/// Where the scene puts a body, as the fluid sees it.
Outline outline(const scene::Body& body, double hydraulic_radius_ratio) {
  const Vec2 position(body.position[0], body.position[1]);
  if (body.shape == "disc") return Disc{position, body.radius * hydraulic_radius_ratio};
  Polygon polygon{to_points(body.outline())};
  for (Vec2& corner : polygon.corners) corner += position;
  return polygon;
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
    out.outline = Disc{out.rigid.centre, m.radius};
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
                      .mean_torque = {0, 0, thickness * t.mean.torque}};
  for (const Vec2& lambda : t.lambda) out.values.insert(out.values.end(), {lambda.x(), lambda.y()});
  return out;
}

/// Of the first body that has a part outside the mesh, and what would stop it; empty where none has.
std::string body_outside(const scene::Scene& scene, const NavierStokes& solver, const Request& request) {
  constexpr int places = 64;  // of each outline
  for (const Interface& interface : request.interfaces)
    for (int k = 0; k < places; ++k) {
      const Vec2 x = interface.outline.at(interface.outline.period() * k / places);
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
  Ledger ledger;
  {
    const ScopedTimer timer(ledger, "mesh");
    scene_ = scene::read_text(message.scene, "the scene sent by the coupler");
    require(scene_.fluid.has_value(),
            "a scene with [fluid] is required; got one without: start no fluid for it");
    check_dimension(scene_);
    grains::expand(scene_, [&](const std::string& name) { return proto::content(message.files, name); });
    const std::string& mesh_name = scene_.fluid->mesh.file;
    const std::string_view text = mesh_name.empty() ? "" : proto::content(message.files, mesh_name);
    solver_.emplace(scene_mesh(*scene_.fluid, scene_.periodic, text), settings(scene_));
  }
  solver_->monitor.ledger = std::move(ledger);
  solver_->monitor.phase = [this](const char* phase) { progress.set(phase); };
  const Mesh& mesh = solver_->mesh();
  if (!message.state.empty())
    solver_->set_state(from_bytes(message.state, mesh.n_nodes(), mesh.n_vertices()));
  require_in_mesh(scene_, *solver_);

  // A gap of one element is resolved, whatever the arcs' length beside it.
  proto::Configured out{.resolved_gap_ratio = 1 / scene_.fluid->embedding.arc_ratio,
                        .notes = solver_->notes()};
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const scene::Body& body = scene_.bodies[b];
    const double length = solver_->arc_length(outline(body, scene_.hydraulic_radius_ratio));
    require(length > 0,
            "the body \"{}\" must lie in the mesh; its outline around ({:g}, {:g}) m meets no element",
            body.name, body.position[0], body.position[1]);
    out.arc_lengths.push_back({static_cast<std::uint32_t>(b), length});
  }
  out.figures = {{"cells", mesh.n_cells()}, {"nodes", mesh.n_nodes()}};
  return out;
}

proto::FluidAdvanced FluidService::advance(const proto::Stamp& stamp, const proto::FluidAdvance& message) {
  Request request{message.time, message.time_step, stamp.sub_iteration, {}, message.wants_resistance};
  for (const proto::Interface& interface : message.interfaces)
    request.interfaces.push_back(read_interface(interface, message.time_step, scene_.thickness));
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
  return {step_figures(scene_, solver())};
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
  for (const auto& [name, seconds] : solver_->monitor.ledger.seconds)
    figures.emplace_back("seconds:" + name, seconds);
  for (const auto& [name, count] : solver_->monitor.ledger.counts) figures.emplace_back(name, count);
  figures.emplace_back("unknowns", solver_->n_unknowns());
  return figures;
}

NavierStokes& FluidService::solver() {
  require(solver_.has_value(),
          "the fluid must be configured before it is asked for anything: send Configure first");
  return *solver_;
}

}  // namespace fpi::fluid
