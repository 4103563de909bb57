#include "simulation.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "coupling/mesh_around_bodies.hpp"
#include "wire.hpp"

namespace fpi {
namespace {

/// Only where a fluid answers to the motion is there something to iterate on.
std::span<const scene::Body> coupled_bodies(const scene::Scene& scene) {
  return scene.fluid ? std::span<const scene::Body>(scene.bodies) : std::span<const scene::Body>();
}

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

Simulation::Simulation(const scene::Scene& scene, Participants participants, std::uint64_t run)
    : scene_(scene),
      participants_(participants),
      run_(run),
      dofs_(coupled_bodies(scene), scene.thickness),
      predictor_(scene.coupling.predictor),
      iteration_(scene.coupling, dofs_),
      arc_lengths_(scene.bodies.size()),
      told_of_coarse_mesh_(scene.bodies.size()) {
  choose_response();
  for (const scene::Body& body : scene.bodies) {
    coupling::RigidMotion motion = coupling::initial_motion(body);
    prescribed_.emplace_back();
    if (!body.is_free()) {
      prescribed_.back().emplace(body);
      motion = prescribed_.back()->with_velocities(motion, 0);
    }
    accepted_.motions.push_back(motion);
  }
  accepted_.loads.resize(scene.bodies.size());
  for (std::uint32_t i = 0; i < scene.walls.size(); ++i) {
    if (!scene.walls[i].moves()) continue;
    moving_walls_.push_back({i, coupling::PrescribedMotion(scene.walls[i])});
    const coupling::RigidMotion start{.position = coupling::to_eigen(scene::to_vec3(scene.walls[i].centre))};
    accepted_.walls.push_back(moving_walls_.back().motion.with_velocities(start, 0));
  }
}

void Simulation::choose_response() {
  const std::string& asked = scene_.coupling.response;
  require(
      asked != "fluid" || participants_.fluid_moves_bodies,
      "coupling.response = \"fluid\" needs a fluid that offers \"balance\"; this one does not: take \"auto\" "
      "or \"analytic\"");
  fluid_moves_bodies_ = participants_.fluid_moves_bodies && (asked == "auto" || asked == "fluid");
  // Gravity is what the DEM adds in the first step, as far as is known.
  force_of_dem_ = dofs_.inertia();
  for (Eigen::Index k = 0; k < dofs_.size(); k += 3)
    force_of_dem_.segment<3>(k).array() *= Eigen::Array3d(scene_.gravity[0], scene_.gravity[1], 0);
}

void Simulation::configure(const Files& files, const StatesByRole& states) {
  if (participants_.fluid) {
    const proto::Configured configured = participants_.fluid->configure(
        configuration(scene_for_fluid(scene_), files, state_of(states, "fluid")));
    log_notes("fluid", configured);
    take_arc_lengths(configured.arc_lengths);
    if (configured.resolved_gap_ratio > 0) resolved_gap_ratio_ = configured.resolved_gap_ratio;
  }
  if (participants_.dem) {
    log_notes("dem", participants_.dem->configure(configuration(scene::part_of(scene::Part::dem, scene_),
                                                                files, state_of(states, "dem"))));
  }
}

void Simulation::take_arc_lengths(const std::vector<proto::ArcLength>& lengths) {
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
void Simulation::warn_where_coarse(std::size_t body) {
  constexpr double clearly = 1.5;
  const double asked = scene_.fluid->mesh.elements_per_diameter;
  if (asked == 0 || told_of_coarse_mesh_[body]) return;
  const double found = coupling::diameter(scene_.bodies[body], scene_.hydraulic_radius_ratio) *
                       scene_.fluid->embedding.arc_ratio / arc_lengths_[body];
  if (clearly * found >= asked) return;
  told_of_coarse_mesh_[body] = true;
  log::warning(
      "body \"{}\" has come where its diameter spans {:.3g} triangles only, not {} "
      "(fluid.mesh.elements_per_diameter): name where free bodies go by fluid.mesh.free_bodies_box",
      scene_.bodies[body].name, found, asked);
}

Attempt Simulation::attempt(double start, double end, double time_step) {
  place_bodies(start, end, time_step);
  added_ = scene_.fluid && scene_.coupling.response != "none"
               ? coupling::added_inertia(dofs_, *scene_.fluid, scene_.hydraulic_radius_ratio, time_step)
               : Eigen::VectorXd::Zero(dofs_.size());
  inertia_ = dofs_.inertia() + added_;
  report_ = {};
  const coupling::CoupledMap map = [this](const Eigen::VectorXd& x, std::uint32_t k) {
    return exchange(x, k);
  };
  static_cast<coupling::StepResult&>(report_) = iteration_.solve(map, first_iterate(), inertia_, time_step);
  return report_;
}

/// The predicted velocities; or, where the fluid moves the bodies, the velocities that the DEM alone would
/// give with its forces of the last step and all inertia.
Eigen::VectorXd Simulation::first_iterate() const {
  if (!fluid_moves_bodies_) return dofs_.velocities(placed_);
  return dofs_.velocities(accepted_.motions) + time_step_ * force_of_dem_.cwiseQuotient(inertia_);
}

/// Free bodies at their predicted places, the others where their formulas say. All sub-iterations share the
/// geometry; only velocities change (numerics: re-cutting costs two to three times and changes the speed by
/// 3e-6 to 8e-4).
void Simulation::place_bodies(double start, double end, double time_step) {
  end_ = end;
  time_step_ = time_step;
  placed_ = accepted_.motions;
  attempted_ = {
      .motions = accepted_.motions, .walls = {}, .loads = accepted_.loads, .arcs = {}, .tractions = {}};
  for (std::size_t i = 0; i < moving_walls_.size(); ++i)
    attempted_.walls.push_back(moving_walls_[i].motion.advanced(accepted_.walls[i], start, end));
  dofs_.set_velocities(predictor_.guess(dofs_.velocities(accepted_.motions), time_step), placed_);
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const coupling::RigidMotion& before = accepted_.motions[i];
    if (prescribed_[i]) {
      placed_[i] = attempted_.motions[i] = prescribed_[i]->advanced(before, start, end);
    } else {
      placed_[i].position = coupling::trapezoidal_position(before, placed_[i].velocity, time_step);
    }
    if (!participants_.fluid) continue;
    attempted_.arcs.push_back(
        coupling::cut_outline(scene_.bodies[i], placed_[i], scene_.hydraulic_radius_ratio, arc_lengths_[i]));
  }
}

/// One answer of the fluid and one of the DEM. Both have moved the free bodies then; the residual is by how
/// much they disagree.
coupling::Exchange Simulation::exchange(const Eigen::VectorXd& x, std::uint32_t sub_iteration) {
  const proto::Stamp stamp{.run = run_, .step = steps_ + 1, .sub_iteration = sub_iteration};
  if (fluid_moves_bodies_)
    attempted_force_of_dem_ = inertia_.cwiseProduct(x - dofs_.velocities(accepted_.motions)) / time_step_;
  else
    dofs_.set_velocities(x, placed_);
  coupling::Exchange answer;
  if (participants_.fluid) answer.reason = advance_fluid(stamp);
  if (participants_.dem && answer.reason.empty()) answer.reason = advance_dem(stamp);
  answer.converged = answer.reason.empty();
  answer.velocities = dofs_.velocities(attempted_.motions);
  answer.forces = dofs_.loads(attempted_.loads);
  answer.residual = answer.velocities - dofs_.velocities(placed_);
  if (!participants_.dem_takes_added_inertia)
    answer.residual.array() *= dofs_.inertia().array() / inertia_.array();
  if (fluid_moves_bodies_) attempted_force_of_dem_ += inertia_.cwiseProduct(answer.residual) / time_step_;
  if (after_exchange) after_exchange(sub_iteration + 1);
  return answer;
}

/// "" or why the fluid did not converge.
std::string Simulation::advance_fluid(const proto::Stamp& stamp) {
  proto::FluidAdvance message{.time = end_, .time_step = time_step_, .interfaces = {}};
  for (std::uint32_t i = 0; i < placed_.size(); ++i)
    message.interfaces.push_back(to_wire(i, attempted_.arcs[i], placed_[i]));
  if (fluid_moves_bodies_) add_balances(message.interfaces);
  proto::FluidAdvanced answer = participants_.fluid->advance(stamp, message);
  report_.newton_iterations += answer.newton_iterations;
  report_.time_error = {.value = answer.time_error, .order = answer.time_error_order};
  if (!answer.converged) return "the fluid did not converge: " + answer.reason;
  take_tractions(std::move(answer.tractions));
  return "";
}

/// Each free body's own balance of momentum, for the fluid to solve with its equations.
void Simulation::add_balances(std::vector<proto::Interface>& interfaces) const {
  for (std::size_t k = 0; k < dofs_.bodies().size(); ++k) {
    const auto at = 3 * static_cast<Eigen::Index>(k);
    const std::size_t body = dofs_.bodies()[k];
    const coupling::RigidMotion& start = accepted_.motions[body];
    const auto force = attempted_force_of_dem_.segment<3>(at);
    interfaces[body].balance = {.mass = dofs_.inertia()[at],
                                .inertia = dofs_.inertia()[at + 2],
                                .velocity = to_wire(start.velocity),
                                .spin = to_wire(start.spin),
                                .force = {force[0], force[1], 0},
                                .torque = {0, 0, force[2]}};
  }
}

void Simulation::take_tractions(std::vector<proto::Traction> tractions) {
  require(tractions.size() == scene_.bodies.size(),
          "the fluid must answer with a traction for each of {} bodies; got {}", scene_.bodies.size(),
          tractions.size());
  for (std::size_t i = 0; i < tractions.size(); ++i) {
    const proto::Traction& traction = tractions[i];
    require(traction.body == i && traction.values.size() == 2 * attempted_.arcs[i].size(),
            "the fluid must answer in the order of the bodies with two values an arc; for body \"{}\" with "
            "{} arcs it "
            "sent {} values of body {}",
            scene_.bodies[i].name, attempted_.arcs[i].size(), traction.values.size(), traction.body);
    attempted_.loads[i] = {.force = coupling::to_eigen(traction.force),
                           .torque = coupling::to_eigen(traction.torque)};
    if (fluid_moves_bodies_ && !prescribed_[i]) {
      placed_[i].velocity = coupling::to_eigen(traction.velocity);
      placed_[i].spin = coupling::to_eigen(traction.spin);
    }
  }
  attempted_.tractions = std::move(tractions);
}

/// "" or why the DEM did not converge.
std::string Simulation::advance_dem(const proto::Stamp& stamp) {
  proto::DemAdvance message{
      .time = end_, .time_step = time_step_, .loads = {}, .prescribed = {}, .resolved_gaps = {}, .walls = {}};
  for (std::size_t i = 0; i < moving_walls_.size(); ++i)
    message.walls.push_back(to_wire(moving_walls_[i].index, attempted_.walls[i]));
  for (std::uint32_t i = 0; i < placed_.size(); ++i)
    if (prescribed_[i]) message.prescribed.push_back(to_wire(i, placed_[i]));
  if (participants_.fluid) message.loads = loads_on_free_bodies();
  if (participants_.fluid)
    for (const double length : arc_lengths_) message.resolved_gaps.push_back(resolved_gap_ratio_ * length);
  const proto::DemAdvanced answer = participants_.dem->advance(stamp, message);
  report_.largest_overlap = answer.largest_overlap;
  if (!answer.converged) return "the DEM did not converge: " + answer.reason;
  take_motions(answer.motions);
  return "";
}

/// What the fluid exerts at the velocities it had, and how that changes with them.
std::vector<proto::Load> Simulation::loads_on_free_bodies() const {
  std::vector<proto::Load> loads;
  for (std::size_t k = 0; k < dofs_.bodies().size(); ++k) {
    const std::size_t body = dofs_.bodies()[k];
    loads.push_back(to_wire(attempted_.arcs[body], attempted_.tractions[body]));
    if (!participants_.dem_takes_added_inertia) continue;
    loads.back().velocity = to_wire(placed_[body].velocity);
    loads.back().spin = to_wire(placed_[body].spin);
    loads.back().added_mass = added_[3 * static_cast<Eigen::Index>(k)];
    loads.back().added_inertia = added_[3 * static_cast<Eigen::Index>(k) + 2];
  }
  return loads;
}

void Simulation::take_motions(const std::vector<proto::Motion>& motions) {
  require(motions.size() == scene_.bodies.size(),
          "the DEM must answer with the motion of each of {} bodies; got {}", scene_.bodies.size(),
          motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    require(motions[i].body == i, "the DEM must answer in the order of the bodies; entry {} is of body {}", i,
            motions[i].body);
    if (!prescribed_[i]) attempted_.motions[i] = from_wire(motions[i]);
  }
}

void Simulation::accept() {
  if (participants_.fluid) {
    const proto::Figures figures = participants_.fluid->accept().figures;
    figures_ = {figures.begin(), figures.end()};
    std::vector<proto::ArcLength> lengths;
    for (const proto::Traction& t : attempted_.tractions)
      lengths.push_back({.body = t.body, .length = t.arc_length});
    take_arc_lengths(lengths);
  }
  if (participants_.dem) participants_.dem->accept();
  predictor_.accept(dofs_.velocities(accepted_.motions), time_step_);
  iteration_.accept();
  if (fluid_moves_bodies_) force_of_dem_ = attempted_force_of_dem_;
  accepted_ = std::move(attempted_);
  ++steps_;
}

void Simulation::restore() {
  if (participants_.fluid) participants_.fluid->restore();
  if (participants_.dem) participants_.dem->restore();
  iteration_.reject();
}

std::optional<double> Simulation::figure(const std::string& name) const {
  const auto found = figures_.find(name);
  return found == figures_.end() ? std::nullopt : std::optional(found->second);
}

NumbersByName Simulation::numbers() const {
  NumbersByName numbers;
  numbers["steps"] = {static_cast<double>(steps_)};
  numbers["arc_lengths"] = arc_lengths_;
  numbers["predictor"] = predictor_.state();
  numbers["acceleration"] = iteration_.state();
  numbers["force_of_dem"] = {force_of_dem_.begin(), force_of_dem_.end()};
  const auto put = [&numbers](const char* name, const auto& vector) {
    numbers[name].insert(numbers[name].end(), vector.begin(), vector.end());
  };
  for (const coupling::RigidMotion& motion : accepted_.motions) {
    put("position", motion.position);
    put("orientation", motion.orientation.coeffs());
    put("velocity", motion.velocity);
    put("spin", motion.spin);
  }
  for (const coupling::RigidMotion& wall : accepted_.walls) {
    put("wall_position", wall.position);
    put("wall_orientation", wall.orientation.coeffs());
  }
  for (const coupling::RigidLoad& load : accepted_.loads) {
    put("force", load.force);
    put("torque", load.torque);
  }
  return numbers;
}

void Simulation::set_numbers(const NumbersByName& numbers) {
  steps_ = static_cast<std::uint64_t>(numbers.at("steps").at(0));
  predictor_.set_state(numbers.at("predictor"));
  iteration_.set_state(numbers.at("acceleration"));
  const std::vector<double>& force = numbers.at("force_of_dem");
  force_of_dem_ = Eigen::Map<const Eigen::VectorXd>(force.data(), static_cast<Eigen::Index>(force.size()));
  if (scene_.bodies.empty()) return;
  arc_lengths_ = numbers.at("arc_lengths");
  const auto triple = [&numbers](const char* name, std::size_t body) {
    return Eigen::Vector3d(&numbers.at(name).at(3 * body));
  };
  for (std::size_t i = 0; i < accepted_.motions.size(); ++i) {
    accepted_.motions[i] = {.position = triple("position", i),
                            .orientation = Eigen::Quaterniond(&numbers.at("orientation").at(4 * i)),
                            .velocity = triple("velocity", i),
                            .spin = triple("spin", i)};
    accepted_.loads[i] = {.force = triple("force", i), .torque = triple("torque", i)};
  }
  for (std::size_t i = 0; i < accepted_.walls.size(); ++i) {
    accepted_.walls[i].position = triple("wall_position", i);
    accepted_.walls[i].orientation = Eigen::Quaterniond(&numbers.at("wall_orientation").at(4 * i));
  }
}

}  // namespace fpi
