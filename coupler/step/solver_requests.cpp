#include "step/solver_requests.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "coupling/mesh_around_bodies.hpp"
#include "step/message_values.hpp"

namespace fpi {
namespace {

void log_notes(const char* role, const proto::Configured& configured) {
  for (const std::string& note : configured.notes) log::info("{}: {}", role, note);
}

/// The scene as the fluid gets it, which knows of refinements only, not of the motion of bodies.
scene::Scene scene_for_fluid(const scene::Scene& scene) {
  coupling::MeshAroundBodies around = coupling::mesh_around_bodies(scene);
  for (const std::string& note : around.notes) log::info("mesh: {}", note);
  scene::Scene refined = scene;
  scene::Mesh& mesh = refined.fluid->mesh;
  mesh.elements_per_diameter = 0;
  mesh.free_bodies_box.clear();
  std::ranges::move(around.refinements, std::back_inserter(mesh.refinements));
  return scene::part_of(scene::Part::fluid, refined);
}

/// What a participant that plays in `part` of the scene is sent.
proto::Configure configuration(scene::Scene part, const Files& files, proto::Bytes state) {
  proto::Configure message{.scene = scene::write_text(part), .files = {}, .state = std::move(state)};
  const std::vector<std::string*> names = scene::file_names(part);
  std::ranges::copy_if(files, std::back_inserter(message.files), [&names](const proto::File& file) {
    return std::ranges::any_of(names, [&file](const std::string* name) { return *name == file.name; });
  });
  return message;
}

proto::Bytes state_of(const StatesByRole& states, const char* role) {
  const auto found = states.find(role);
  return found == states.end() ? proto::Bytes{} : found->second;
}

}  // namespace

double elements_per_diameter(const scene::Scene& scene, std::size_t body, double arc_length) {
  return coupling::diameter(scene.bodies[body], scene.hydraulic_radius_ratio) *
         scene.fluid->embedding.arc_ratio / arc_length;
}

SolverRequests::SolverRequests(const scene::Scene& scene, const coupling::RigidDofs& dofs,
                               Participants participants, bool fluid_moves_bodies)
    : scene_(scene),
      dofs_(dofs),
      participants_(participants),
      fluid_moves_bodies_(fluid_moves_bodies),
      arc_lengths_(scene.bodies.size()),
      told_of_coarse_mesh_(scene.bodies.size()) {
  for (std::uint32_t i = 0; i < scene.walls.size(); ++i)
    if (scene.walls[i].moves()) moving_walls_.push_back(i);
}

Findings SolverRequests::configure(const Files& files, const StatesByRole& states) {
  Findings findings;
  const auto take = [&](const char* role, const proto::Configured& configured) {
    log_notes(role, configured);
    findings.append(configured.findings);
    configured_figures_[role] = configured.figures;
    return !Findings(configured.findings).has_errors();
  };
  if (participants_.fluid) {
    const proto::Configured configured = participants_.fluid->configure(
        configuration(scene_for_fluid(scene_), files, state_of(states, "fluid")));
    if (take("fluid", configured)) {
      take_arc_lengths(configured.arc_lengths);
      find_unresolved(findings);
      if (configured.resolved_gap_ratio > 0) resolved_gap_ratio_ = configured.resolved_gap_ratio;
    }
  }
  if (participants_.dem)
    take("dem", participants_.dem->configure(
                    configuration(scene::part_of(scene::Part::dem, scene_), files, state_of(states, "dem"))));
  return findings;
}

/// Below six elements across a diameter the drag of a disc is some per cent off (docs/numerics.md).
void SolverRequests::find_unresolved(Findings& findings) const {
  constexpr double fewest = 6;
  for (std::size_t i = 0; i < arc_lengths_.size(); ++i) {
    const double spans = elements_per_diameter(scene_, i, arc_lengths_[i]);
    if (spans >= fewest) continue;
    findings.warn(
        fmt::format("bodies.{}.{}", i, scene_.bodies[i].shape == "polygon" ? "vertices" : "radius"),
        "the diameter of the body \"{}\" spans {:.3g} elements, below {:g}: its drag is off by some "
        "per cent; {}",
        scene_.bodies[i].name, spans, fewest,
        scene_.fluid->mesh.file.empty() ? "set fluid.mesh.elements_per_diameter, or take smaller cells"
                                        : "make the mesh finer there");
  }
}

void SolverRequests::take_arc_lengths(const std::vector<proto::ArcLength>& lengths) {
  for (const auto& [body, length] : lengths) {
    require(body < arc_lengths_.size(), "the fluid must name bodies 0 to {} in its arc lengths; got {}",
            arc_lengths_.size(), body);
    arc_lengths_[body] = length;
  }
  for (std::size_t i = 0; i < arc_lengths_.size(); ++i) {
    require(arc_lengths_[i] > 0, "the fluid must say an arc length > 0 m for body \"{}\"; got {}",
            scene_.bodies[i].name, arc_lengths_[i]);
    warn_where_coarse(i);
  }
}

/// Tells once when a body comes where triangles are clearly larger than the scene asks for beside it.
void SolverRequests::warn_where_coarse(std::size_t body) {
  constexpr double clearly = 1.5;
  const double asked = scene_.fluid->mesh.elements_per_diameter;
  if (asked == 0 || told_of_coarse_mesh_[body]) return;
  const double found = elements_per_diameter(scene_, body, arc_lengths_[body]);
  if (clearly * found >= asked) return;
  told_of_coarse_mesh_[body] = true;
  log::warning(
      "body \"{}\" has come where its diameter spans {:.3g} triangles only, not {} "
      "(fluid.mesh.elements_per_diameter): name where free bodies go by fluid.mesh.free_bodies_box",
      scene_.bodies[body].name, found, asked);
}

std::string SolverRequests::advance_fluid(const proto::Stamp& stamp, const CoupledState& before,
                                          Trial& trial) {
  if (!participants_.fluid) return "";
  const bool wants_resistance = trial.wants_resistance && stamp.sub_iteration == 0;
  proto::FluidAdvance message = message_to_fluid(before, trial);
  message.wants_resistance = wants_resistance;
  proto::FluidAdvanced answer = participants_.fluid->advance(stamp, message);
  trial.report.newton_iterations += answer.newton_iterations;
  trial.report.time_error = {.value = answer.time_error, .order = answer.time_error_order};
  if (!answer.converged) return "the fluid did not converge: " + answer.reason;
  take_tractions(std::move(answer.tractions), trial);
  if (wants_resistance) take_resistance(answer.resistance, trial);
  trial.fluid_speed = answer.speed;
  return "";
}

proto::FluidAdvance SolverRequests::message_to_fluid(const CoupledState& before, const Trial& trial) const {
  proto::FluidAdvance message{.time = trial.end, .time_step = trial.time_step, .interfaces = {}};
  for (std::uint32_t i = 0; i < trial.placed.size(); ++i)
    if (before.is_there(i)) message.interfaces.push_back(to_wire(i, trial.state.arcs[i], trial.placed[i]));
  if (fluid_moves_bodies_) add_balances(before, trial, message.interfaces);
  return message;
}

Findings SolverRequests::rehearse(const proto::Stamp& stamp, const CoupledState& before, const Trial& trial) {
  if (!participants_.fluid) return {};
  proto::FluidAdvance message = message_to_fluid(before, trial);
  message.rehearsal = true;
  return participants_.fluid->advance(stamp, message).findings;
}

/// Each free body's own balance of momentum, for the fluid to solve with its equations.
void SolverRequests::add_balances(const CoupledState& before, const Trial& trial,
                                  std::vector<proto::Interface>& interfaces) const {
  auto interface = interfaces.begin();
  for (std::size_t k = 0; k < dofs_.bodies().size(); ++k) {
    const auto at = 3 * static_cast<Eigen::Index>(k);
    const std::size_t body = dofs_.bodies()[k];
    if (!before.is_there(body)) continue;
    while (interface->body != body) ++interface;
    const coupling::RigidMotion& start = before.motions[body];
    const auto force = trial.force_of_dem.segment<3>(at);
    interface->balance = {.mass = dofs_.inertia()[at],
                          .inertia = dofs_.inertia()[at + 2],
                          .velocity = to_wire(start.velocity),
                          .spin = to_wire(start.spin),
                          .force = {force[0], force[1], 0},
                          .torque = {0, 0, force[2]}};
  }
}

void SolverRequests::take_resistance(std::span<const double> by_rows, Trial& trial) const {
  if (by_rows.empty()) return;
  const std::vector<Eigen::Index> unknowns = unknowns_there(trial.state);
  const auto n = static_cast<Eigen::Index>(unknowns.size());
  require(by_rows.size() == static_cast<std::size_t>(n * n),
          "the fluid must answer with a resistance of {0} rows and columns, or with none; got {1} numbers", n,
          by_rows.size());
  trial.resistance = Eigen::MatrixXd::Zero(dofs_.size(), dofs_.size());
  trial.resistance(unknowns, unknowns) = Eigen::Map<const Eigen::MatrixXd>(by_rows.data(), n, n).transpose();
}

/// Those of free bodies that have not left.
std::vector<Eigen::Index> SolverRequests::unknowns_there(const CoupledState& state) const {
  std::vector<Eigen::Index> unknowns;
  for (std::size_t k = 0; k < dofs_.bodies().size(); ++k) {
    if (!state.is_there(dofs_.bodies()[k])) continue;
    for (Eigen::Index axis = 0; axis < 3; ++axis) unknowns.push_back(3 * static_cast<Eigen::Index>(k) + axis);
  }
  return unknowns;
}

void SolverRequests::take_tractions(std::vector<proto::Traction> tractions, Trial& trial) const {
  const auto n = static_cast<std::size_t>(std::ranges::count(trial.state.left, false));
  require(tractions.size() == n, "the fluid must answer with a traction for each of {} bodies; got {}", n,
          tractions.size());
  trial.state.tractions.assign(scene_.bodies.size(), {});
  auto next = tractions.begin();
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    if (!trial.state.is_there(i)) continue;
    proto::Traction& traction = trial.state.tractions[i] = std::move(*next++);
    const std::size_t n_arcs = trial.state.arcs[i].size();
    require(traction.body == i && traction.values.size() == 2 * n_arcs,
            "the fluid must answer in the order of the bodies with two values an arc; for body \"{}\" with "
            "{} arcs it sent {} values of body {}",
            scene_.bodies[i].name, n_arcs, traction.values.size(), traction.body);
    proto::Vec3 force = traction.force, torque = traction.torque;
    if (scene_.bodies[i].is_free()) {
      force = traction.mean_force.value_or(force);
      torque = traction.mean_torque.value_or(torque);
    }
    trial.state.loads[i] = {.force = coupling::to_eigen(force), .torque = coupling::to_eigen(torque)};
    if (fluid_moves_bodies_ && scene_.bodies[i].is_free()) {
      trial.placed[i].velocity = coupling::to_eigen(traction.velocity);
      trial.placed[i].spin = coupling::to_eigen(traction.spin);
    }
  }
}

std::string SolverRequests::advance_dem(const proto::Stamp& stamp, Trial& trial) {
  if (!participants_.dem) return "";
  const proto::DemAdvanced answer = participants_.dem->advance(stamp, message_to_dem(trial));
  trial.report.largest_overlap = answer.largest_overlap;
  if (!answer.converged) return "the DEM did not converge: " + answer.reason;
  take_motions(answer.motions, trial.state);
  trial.state.contacts = answer.contacts;
  return "";
}

proto::DemAdvance SolverRequests::message_to_dem(const Trial& trial) const {
  proto::DemAdvance message{.time = trial.end,
                            .time_step = trial.time_step,
                            .loads = {},
                            .prescribed = {},
                            .resolved_gaps = {},
                            .walls = {},
                            .resistance = {}};
  for (std::size_t i = 0; i < moving_walls_.size(); ++i)
    message.walls.push_back(to_wire(moving_walls_[i], trial.state.walls[i]));
  for (std::uint32_t i = 0; i < trial.placed.size(); ++i)
    if (!scene_.bodies[i].is_free()) message.prescribed.push_back(to_wire(i, trial.placed[i]));
  if (!participants_.fluid) return message;
  message.loads = loads_on_free_bodies(trial);
  for (const double length : arc_lengths_) message.resolved_gaps.push_back(resolved_gap_ratio_ * length);
  if (trial.resistance.size() == 0) return message;
  const std::vector<Eigen::Index> unknowns = unknowns_there(trial.state);
  const Eigen::MatrixXd there = trial.resistance(unknowns, unknowns);
  const auto by_rows = there.reshaped<Eigen::RowMajor>();
  message.resistance.assign(by_rows.begin(), by_rows.end());
  return message;
}

/// What the fluid exerts at the velocities it had, and how that changes with them.
std::vector<proto::Load> SolverRequests::loads_on_free_bodies(const Trial& trial) const {
  std::vector<proto::Load> loads;
  for (std::size_t k = 0; k < dofs_.bodies().size(); ++k) {
    const std::size_t body = dofs_.bodies()[k];
    if (!trial.state.is_there(body)) continue;
    loads.push_back(trial.state.tractions.empty()
                        ? to_wire(static_cast<std::uint32_t>(body), trial.state.loads[body])
                        : to_wire(trial.state.arcs[body], trial.state.tractions[body]));
    if (!participants_.dem_takes_added_inertia) continue;
    loads.back().velocity = to_wire(trial.placed[body].velocity);
    loads.back().spin = to_wire(trial.placed[body].spin);
    loads.back().added_mass = trial.added[3 * static_cast<Eigen::Index>(k)];
    loads.back().added_inertia = trial.added[3 * static_cast<Eigen::Index>(k) + 2];
  }
  return loads;
}

void SolverRequests::take_motions(const std::vector<proto::Motion>& motions, CoupledState& state) const {
  require(motions.size() == scene_.bodies.size(),
          "the DEM must answer with the motion of each of {} bodies; got {}", scene_.bodies.size(),
          motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    require(motions[i].body == i, "the DEM must answer in the order of the bodies; entry {} is of body {}", i,
            motions[i].body);
    if (scene_.bodies[i].is_free() && state.is_there(i)) state.motions[i] = from_wire(motions[i]);
  }
}

void SolverRequests::accept(const CoupledState& state, const std::vector<Departure>& leaving) {
  proto::Accept message;
  for (const Departure& departure : leaving)
    message.left.push_back(static_cast<std::uint32_t>(departure.body));
  figures_.clear();
  const auto take = [this](const proto::Accepted& accepted) {
    figures_.insert(accepted.figures.begin(), accepted.figures.end());
    findings_.append(accepted.findings);
  };
  if (participants_.fluid) {
    take(participants_.fluid->accept(message));
    take_arc_lengths(wanted_lengths(state));
  }
  if (participants_.dem) take(participants_.dem->accept(message));
}

/// Of the bodies that are there. One that is on its way out of the mesh keeps the length that it had.
std::vector<proto::ArcLength> SolverRequests::wanted_lengths(const CoupledState& state) const {
  std::vector<proto::ArcLength> lengths;
  for (std::uint32_t i = 0; i < state.tractions.size(); ++i) {
    if (!state.is_there(i)) continue;
    const double length = state.tractions[i].arc_length;
    const Eigen::Vector3d& at = state.motions[i].position;
    require(length > 0 || is_at_outlet(scene_, scene_.bodies[i], at),
            "body \"{}\" must stay in the mesh, or leave through one of [[outlets]]; at ({:g}, {:g}) m it "
            "meets no element: stop it with one of [[walls]], add an outlet there, make the mesh larger, or "
            "end the run earlier",
            scene_.bodies[i].name, at.x(), at.y());
    if (length > 0) lengths.push_back({.body = i, .length = length});
  }
  return lengths;
}

void SolverRequests::restore() {
  if (participants_.fluid) participants_.fluid->restore();
  if (participants_.dem) participants_.dem->restore();
}

std::optional<double> SolverRequests::figure(const std::string& name) const {
  const auto found = figures_.find(name);
  return found == figures_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace fpi
