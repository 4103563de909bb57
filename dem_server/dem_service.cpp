#include "dem_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/error.hpp"
#include "grains/expand.hpp"
#include "scene/scene.hpp"
#include "stl.hpp"

namespace fpi::dem {
namespace {

Vec3 to_eigen(const proto::Vec3& v) { return {v[0], v[1], v[2]}; }
proto::Vec3 to_wire(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

using Meshes = std::map<std::string, std::vector<Corners>>;  ///< by the names of their files

/// The meshes of walls; what is to be said of them is added to `notes`.
Meshes read_meshes(const scene::Scene& scene, const std::vector<proto::File>& files,
                   std::vector<std::string>& notes, Findings& findings) {
  Meshes meshes;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const scene::Wall& wall = scene.walls[i];
    if (wall.shape != "mesh" || meshes.contains(wall.file)) continue;
    findings.attempt(fmt::format("walls.{}.file", i), [&] {
      StlMesh mesh = read_stl(proto::content(files, wall.file), wall.file);
      meshes[wall.file] = std::move(mesh.triangles);
      if (!mesh.note.empty()) notes.push_back(std::move(mesh.note));
    });
  }
  return meshes;
}

Problem make_problem(const scene::Scene& scene, Meshes meshes) {
  return {.gravity = to_eigen(scene::to_vec3(scene.gravity)),
          .thickness = scene.thickness,
          .duration = scene.time.end,
          .hydraulic_radius_ratio = scene.hydraulic_radius_ratio,
          .periodic = scene.periodic,
          .dem = scene.dem.value_or(scene::Dem{}),
          .bodies = scene.bodies,
          .materials = scene.materials,
          .walls = scene.walls,
          .meshes = std::move(meshes)};
}

std::vector<Load> read_loads(const std::vector<proto::Load>& messages) {
  std::vector<Load> loads;
  for (const auto& m : messages)
    loads.push_back({m.body, to_eigen(m.force), to_eigen(m.torque), to_eigen(m.velocity), to_eigen(m.spin),
                     m.added_mass, m.added_inertia});
  return loads;
}

std::vector<Prescribed> read_prescribed(const std::vector<proto::Motion>& messages) {
  std::vector<Prescribed> prescribed;
  for (const auto& m : messages) {
    const auto& [w, x, y, z] = m.orientation;
    prescribed.push_back(
        {m.body, to_eigen(m.position), Quaternion(w, x, y, z), to_eigen(m.velocity), to_eigen(m.spin)});
  }
  return prescribed;
}

std::vector<proto::Motion> write_motions(const Motions& motions) {
  std::vector<proto::Motion> messages;
  for (std::uint32_t i = 0; i < motions.position.size(); ++i) {
    const Quaternion& q = motions.orientation[i].base;
    messages.push_back({.body = i,
                        .position = to_wire(motions.position[i]),
                        .orientation = {q.w(), q.x(), q.y(), q.z()},
                        .velocity = to_wire(motions.velocity[i]),
                        .spin = to_wire(motions.spin[i])});
  }
  return messages;
}

/// Duration [s] of the shortest impact that is to be expected: two of the smallest free bodies that meet as
/// fast as the fastest starts, or after a fall through the diameter of the largest. Nothing where none can.
std::optional<double> shortest_contact(const Model& model, const Motions& start) {
  double mass = 0, radius = 0, largest = 0, speed = 0;
  std::size_t material = 0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    speed = std::max(speed, start.velocity[i].norm());
    if (!model.bodies.is_free(i)) continue;
    largest = std::max(largest, model.bodies.radius[i]);
    if (mass > 0 && model.bodies.mass[i] >= mass) continue;
    mass = model.bodies.mass[i];
    radius = model.bodies.radius[i];
    material = model.bodies.material[i];
  }
  speed = std::max(speed, std::sqrt(4 * model.gravity.norm() * largest));
  const bool can_touch = model.bodies.size() > 1 || !model.walls.walls.empty();
  if (!can_touch || !(mass > 0) || !(speed > 0) || model.laws.n_materials() == 0) return std::nullopt;
  const PairLaw& law = model.laws(material, material);
  const double time = contact_time(model.elasticity, law, {0.5 * mass, 0.5 * radius, 0, speed});
  return std::isfinite(time) && time > 0 ? std::optional(time) : std::nullopt;
}

/// Adds what is left out in this scene, and why.
void add_notes(const Model& model, std::vector<std::string>& notes) {
  if (model.walls.walls.empty() && model.bodies.size() == 1)
    notes.emplace_back("one body and no wall: no contact");
  if (model.stretch > 1)
    notes.push_back(fmt::format("contacts last {:g} times as long as the materials say", model.stretch));
  notes.emplace_back("sub-steps only while something touches or is about to");
  if (lists_every_pair(model)) notes.emplace_back("few bodies: every pair is watched, none searched for");
}

}  // namespace

proto::Configured DemService::configure(const proto::Configure& message) {
  progress.set("configure");
  scene::Scene scene = scene::read_text(message.scene, "the scene sent by the coupler");
  grains::expand(scene, [&](const std::string& name) { return proto::content(message.files, name); });
  longest_step_ = (1 + 1e-6) * scene.time.end;  // which is hit to round-off
  Findings findings;
  std::vector<std::string> notes;
  Meshes meshes = read_meshes(scene, message.files, notes, findings);
  if (!findings.has_errors()) solver_.emplace(make_problem(scene, std::move(meshes)), findings);
  if (findings.has_errors()) {
    solver_.reset();
    return {.findings = findings.all()};
  }
  if (!message.state.empty()) solver_->resume(message.state);
  const Model& model = solver_->model();
  add_notes(model, notes);
  proto::Configured out{.notes = std::move(notes),
                        .figures = {{"bodies", static_cast<double>(model.bodies.size())}},
                        .findings = findings.all()};
  if (const auto time = shortest_contact(model, solver_->motions()))
    out.figures.emplace_back("resolution:contact_time", *time);
  return out;
}

proto::DemAdvanced DemService::advance(const proto::Stamp&, const proto::DemAdvance& message) {
  const ScopedTimer timer(timers_, "dem");
  require(message.time_step <= longest_step_,
          "a step of at most {} s is required, the end of the scene (time.end); got {} s", longest_step_,
          message.time_step);
  progress.set("contacts");
  time_ = message.time;
  const Advanced outcome =
      solver().advance(message.time_step, read_loads(message.loads), read_prescribed(message.prescribed),
                       message.resolved_gaps, read_prescribed(message.walls), message.resistance);
  timers_.counts["sub_steps"] += static_cast<double>(outcome.sub_steps);
  timers_.counts["neighbour_searches"] += static_cast<double>(outcome.searches);
  return {.converged = outcome.converged,
          .reason = outcome.reason,
          .motions = outcome.converged ? write_motions(solver().motions()) : std::vector<proto::Motion>{},
          .sub_steps = outcome.sub_steps,
          .contacts = message.loads.empty() ? std::vector<std::uint32_t>{} : solver().contacts(),
          .largest_overlap = outcome.largest_overlap};
}

proto::Accepted DemService::accept(const proto::Accept& message) {
  solver().accept(message.left);
  solver().check_none_lost(time_);
  return {.figures = energies()};
}

proto::Figures DemService::energies() const {
  proto::Figures figures;
  const auto account = solver_ ? solver_->energies() : std::nullopt;
  for (std::size_t e = 0; account && e < account->size(); ++e)
    figures.emplace_back(scene::energy_column(e), (*account)[e]);
  return figures;
}

void DemService::restore() { solver().restore(); }

proto::State DemService::checkpoint() { return {solver().checkpoint()}; }

proto::Figures DemService::report() {
  proto::Figures figures(timers_.counts.begin(), timers_.counts.end());
  for (const auto& [name, seconds] : timers_.seconds) figures.emplace_back("seconds:" + name, seconds);
  std::ranges::copy(energies(), std::back_inserter(figures));
  if (solver_ && solver_->model().stretch > 1) figures.emplace_back("stretch", solver_->model().stretch);
  return figures;
}

Solver& DemService::solver() {
  require(solver_.has_value(),
          "the DEM must be configured before it is asked for anything: send Configure first");
  return *solver_;
}

}  // namespace fpi::dem
