#include "results/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/error.hpp"
#include "results/end_state.hpp"
#include "results/groups.hpp"
#include "step/message_values.hpp"

namespace fpi {
namespace {

std::vector<std::string> history_columns(const scene::Scene& scene) {
  std::vector<std::string> columns{"time",           "step",
                                   "sub_iterations", "residual_velocity",
                                   "residual_force", "newton_iterations",
                                   "columns_kept",   "columns_dropped",
                                   "displacement",   "miss",
                                   "recuts"};
  for (std::size_t i = 0; i < scene.n_listed(); ++i)
    for (const char* quantity : {"x", "y", "vx", "vy", "spin", "fx", "fy", "torque"})
      columns.push_back(scene.bodies[i].name + "." + quantity);
  for (const scene::Grains& group : scene.grains)
    for (const char* quantity : {"count", "x", "y", "z", "vx", "vy", "vz", "kinetic_energy"})
      columns.push_back(group.name + "." + quantity);
  for (const scene::Outlet& outlet : scene.outlets)
    for (const char* quantity : {"count", "mass", "momentum_x", "momentum_y", "momentum_z"})
      columns.push_back(outlet.name + "." + quantity);
  for (const std::string& boundary : holding_boundaries(scene))
    for (const char* quantity : {"fx", "fy", "torque"}) columns.push_back(boundary + "." + quantity);
  for (const scene::Probe& probe : scene.probes) columns.push_back(probe.name);
  for (const std::string& drive : found_drives(scene)) columns.push_back(drive);
  for (const scene::Coefficients& coefficients : scene.coefficients)
    for (const char* quantity : {"drag", "lift"}) columns.push_back(column_of(coefficients, quantity));
  for (std::size_t e = 0; has_energies(scene) && e < scene::Dem::energies.size(); ++e)
    columns.push_back(scene::energy_column(e));
  return columns;
}

std::optional<output::BodyWriter> new_body_file(const scene::Scene& scene, const std::string& folder) {
  if (scene.bodies.empty()) return std::nullopt;
  std::vector<std::string> names;
  std::vector<double> radii;
  for (const scene::Body& body : scene.bodies) {
    names.push_back(body.name);
    radii.push_back(body.radius);
  }
  return std::optional<output::BodyWriter>(std::in_place, folder, names, radii);
}

bool has_interface(const scene::Scene& scene) { return scene.fluid && !scene.bodies.empty(); }

/// A file of curves, made when there are any.
void record_curves(double time, const std::vector<proto::Curve>& curves, const std::string& path,
                   const char* quantity, std::optional<output::CurveWriter>& writer) {
  if (curves.empty()) return;
  if (!writer) writer.emplace(path, quantity);
  std::vector<output::CurveView> views;
  for (const proto::Curve& curve : curves)
    views.push_back({curve.name, curve.points, curve.lines, curve.components, curve.values});
  writer->write(time, views);
}

/// Of a body that left.
output::BodyRow nowhere() {
  std::array<double, 3> nothing;
  nothing.fill(std::nan(""));
  return {nothing, nothing, nothing, nothing, nothing, nothing};
}

std::string left_file(const std::string& folder) { return folder + "/left_bodies.csv"; }
std::string boundary_file(const std::string& folder) { return folder + "/boundaries.h5"; }
std::string profile_file(const std::string& folder) { return folder + "/profiles.h5"; }

}  // namespace

std::string history_file(const std::string& folder) { return folder + "/history.csv"; }

Recorder::Recorder(const scene::Scene& scene, const std::string& folder)
    : scene_(scene),
      folder_(folder),
      history_(history_file(folder), history_columns(scene)),
      bodies_(new_body_file(scene, folder)) {
  if (has_interface(scene)) interface_.emplace(folder);
  if (scene.outlets.empty()) return;
  std::vector<std::string> columns{"time", "body", "outlet", "mass"};
  std::ranges::copy(end_state_columns(scene), std::back_inserter(columns));
  left_.emplace(left_file(folder), columns);
}

Recorder::Recorder(const scene::Scene& scene, const std::string& folder, const std::vector<double>& sizes)
    : scene_(scene), folder_(folder), history_(history_file(folder), static_cast<std::size_t>(sizes.at(0))) {
  const auto kept = [&sizes](std::size_t i) { return static_cast<std::size_t>(sizes.at(i)); };
  if (!scene.bodies.empty()) bodies_.emplace(folder, kept(5));
  if (has_interface(scene)) interface_.emplace(folder, kept(1));
  if (!scene.outlets.empty()) left_.emplace(left_file(folder), kept(6));
  if (kept(2) > 0) fields_.emplace(folder, kept(2));
  if (kept(3) > 0) boundaries_.emplace(boundary_file(folder), "traction", kept(3));
  if (kept(4) > 0) profiles_.emplace(profile_file(folder), "value", kept(4));
}

void Recorder::flush() {
  if (bodies_) bodies_->flush();
}

std::vector<double> Recorder::sizes() const {
  const auto size = [](const auto& writer) { return writer ? static_cast<double>(writer->size()) : 0; };
  return {static_cast<double>(history_.size()),
          size(interface_),
          size(fields_),
          size(boundaries_),
          size(profiles_),
          size(bodies_),
          size(left_)};
}

void Recorder::record_step(double time, const Attempt& attempt, const CoupledProblem& problem,
                           const Reported& reported) {
  std::vector<double> line{time,
                           static_cast<double>(problem.steps()),
                           static_cast<double>(attempt.sub_iterations),
                           attempt.velocity.relative,
                           attempt.force.relative,
                           static_cast<double>(attempt.newton_iterations),
                           static_cast<double>(attempt.columns.kept),
                           static_cast<double>(attempt.columns.dropped),
                           attempt.displacement,
                           attempt.miss,
                           static_cast<double>(attempt.recuts)};
  for (std::size_t i = 0; i < scene_.n_listed(); ++i) {
    const coupling::RigidMotion& motion = problem.state().motions[i];
    const auto& [force, torque] = problem.state().loads[i];
    line.insert(line.end(), {motion.position.x(), motion.position.y(), motion.velocity.x(),
                             motion.velocity.y(), motion.spin.z(), force.x(), force.y(), torque.z()});
  }
  for (const GroupMotion& group : group_motions(scene_, problem.state())) {
    line.push_back(static_cast<double>(group.count));
    line.insert(line.end(), group.position.begin(), group.position.end());
    line.insert(line.end(), group.velocity.begin(), group.velocity.end());
    line.push_back(group.kinetic_energy);
  }
  for (const Departed& departed : problem.state().departed) {
    line.insert(line.end(), {departed.count, departed.mass});
    line.insert(line.end(), departed.momentum.begin(), departed.momentum.end());
  }
  for (const BoundaryLoad& load : reported.boundaries)
    line.insert(line.end(), {load.fx, load.fy, load.torque});
  line.insert(line.end(), reported.probes.begin(), reported.probes.end());
  line.insert(line.end(), reported.drives.begin(), reported.drives.end());
  for (const DragLift& c : reported.coefficients) line.insert(line.end(), {c.drag, c.lift});
  line.insert(line.end(), reported.energies.begin(), reported.energies.end());
  history_.append(line);
  record_departures(time, problem.departures());
}

void Recorder::record_departures(double time, const std::vector<Departure>& departures) {
  for (const Departure& departure : departures) {
    std::vector<double> line{time, static_cast<double>(departure.body), static_cast<double>(departure.outlet),
                             departure.mass};
    std::ranges::copy(end_state(scene_, departure.body, departure.motion), std::back_inserter(line));
    left_->append(line);
  }
}

void Recorder::record_bodies(double time, const CoupledState& state) {
  if (!bodies_) return;
  std::vector<output::BodyRow> rows;
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    if (!state.is_there(i)) {
      rows.push_back(nowhere());
      continue;
    }
    const coupling::RigidMotion& motion = state.motions[i];
    const Eigen::AngleAxisd rotation(motion.orientation);
    rows.push_back(
        {.position = to_wire(motion.position),
         .rotation = to_wire(rotation.axis() * std::remainder(rotation.angle(), 2 * std::numbers::pi)),
         .velocity = to_wire(motion.velocity),
         .spin = to_wire(motion.spin),
         .force = to_wire(state.loads[i].force),
         .torque = to_wire(state.loads[i].torque)});
  }
  bodies_->append(time, rows);
}

void Recorder::record_interface(double time, const CoupledState& state) {
  if (!interface_) return;
  output::InterfaceArrays all;
  for (std::uint32_t i = 0; i < state.arcs.size(); ++i) {
    const coupling::Arcs& arcs = state.arcs[i];
    all.body.insert(all.body.end(), arcs.size(), i);
    const auto angle = [&arcs](const std::vector<double>& angles, std::size_t a) {
      return angles.empty() ? std::nan("") : angles[a];
    };
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      const Eigen::Vector2d middle = arcs.centre.head<2>() + arcs.from_centre(a, 0.5);
      all.start.push_back(angle(arcs.start, a));
      all.end.push_back(angle(arcs.end, a));
      all.middle.insert(all.middle.end(), {middle.x(), middle.y()});
    }
    all.traction.insert(all.traction.end(), state.tractions[i].values.begin(),
                        state.tractions[i].values.end());
    all.centre.insert(all.centre.end(), {arcs.centre.x(), arcs.centre.y()});
  }
  interface_->write(time, all);
}

void Recorder::record_fields(double time, const proto::Fields& fields) {
  if (!fields_) fields_.emplace(folder_);
  if (!fields_->has_mesh()) {
    require(!fields.points.empty() && fields.points.size() % 3 == 0 && !fields.cells.empty(),
            "the fluid must send its mesh with the first fields; got {} coordinates and {} cell corners",
            fields.points.size(), fields.cells.size());
    std::vector<double> points;
    for (std::size_t p = 0; p < fields.points.size(); p += 3) {
      points.insert(points.end(), {fields.points[p], fields.points[p + 1]});
    }
    fields_->write_mesh(points, fields.cells);
  }
  std::vector<output::FieldView> views;
  for (const proto::Field& field : fields.fields) {
    views.push_back({field.name, field.on_cells, field.components, field.values});
  }
  fields_->write(time, views);
  record_curves(time, fields.boundaries, boundary_file(folder_), "traction", boundaries_);
  record_curves(time, fields.profiles, profile_file(folder_), "value", profiles_);
  for (const proto::Sheet& table : fields.tables)  // anew each time
    output::write_table(folder_ + "/" + table.name + ".csv", table.columns, table.values);
}

}  // namespace fpi
