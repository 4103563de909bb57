#include "measurements.hpp"

#include "core/error.hpp"
#include "fluid/measure/profile.hpp"

namespace fpi::fluid {
namespace {

Vec2 to_plane(const std::vector<double>& v) { return {v[0], v[1]}; }

/// A quantity by its name in the scene, where the flow has a value.
std::optional<double> read(const NavierStokes& solver, const std::string& quantity, const Vec2& x) {
  const auto found = solver.at(x);
  if (!found) return std::nullopt;
  const auto& [velocity, pressure] = *found;
  if (quantity == "pressure") return pressure;
  if (quantity == "speed") return velocity.norm();
  return velocity[quantity == "velocity_x" ? 0 : 1];
}

std::optional<double> read(const NavierStokes& solver, const scene::Probe& probe) {
  if (probe.is_mean()) return solver.superficial_velocity()[probe.quantity.ends_with("x") ? 0 : 1];
  const auto value = read(solver, probe.quantity, to_plane(probe.point));
  if (!value || probe.minus.empty()) return value;
  const auto minus = read(solver, probe.quantity, to_plane(probe.minus));
  return minus ? std::optional(*value - *minus) : std::nullopt;
}

std::optional<Profile> measure(const NavierStokes& solver, const scene::Profile& p) {
  return measure_profile(solver.mesh(), solver.locator(), to_plane(p.from), to_plane(p.to),
                         [&](const Vec2& x) { return read(solver, p.quantity, x); });
}

void add_extremum(const std::string& kind, const std::string& name, const ProfilePoint& point,
                  proto::Figures& figures) {
  figures.emplace_back(kind + ":" + name, point.value);
  figures.emplace_back(kind + "_x:" + name, point.place.x());
  figures.emplace_back(kind + "_y:" + name, point.place.y());
}

FlowErrors errors(const scene::Exact& exact, const NavierStokes& solver) {
  const Expression ux(exact.velocity[0], "exact.velocity.0"), uy(exact.velocity[1], "exact.velocity.1");
  const Expression p(exact.pressure, "exact.pressure");
  const double t = solver.state().time;
  return solver.errors({[&](const Vec2& x) { return Vec2(ux(x.x(), x.y(), t), uy(x.x(), x.y(), t)); },
                        [&](const Vec2& x) { return p(x.x(), x.y(), t); }});
}

}  // namespace

std::vector<Vec2> to_points(const std::vector<double>& coordinates) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2)
    points.emplace_back(coordinates[i], coordinates[i + 1]);
  return points;
}

Surface surface(const scene::Body& body, double hydraulic_radius_ratio) {
  const Vec2 position(body.position[0], body.position[1]);
  if (body.shape == "disc") return Disc{position, body.radius * hydraulic_radius_ratio};
  Polygon polygon{to_points(body.surface())};
  for (Vec2& corner : polygon.corners) corner += position;
  return polygon;
}

void check_places(const scene::Scene& scene, const Mesh& mesh, const Locator& locator, Findings& findings) {
  const auto check = [&](const char* list, std::size_t i, const char* key, const std::string& name,
                         const std::vector<double>& point) {
    if (point.empty()) return;
    const Vec2 x = to_plane(point);
    const std::string where = fmt::format("{}s.{}.{}", list, i, key);
    if (!locator.find(x))
      findings.error(where, "the {} \"{}\" must lie in the mesh; ({:g}, {:g}) m does not: move it", list,
                     name, x.x(), x.y());
    if (std::string_view(list) != "probe") return;  // a profile may pass through bodies
    for (const scene::Body& body : scene.bodies) {
      if (!body.is_plane()) continue;
      const Surface surface = fluid::surface(body, scene.hydraulic_radius_ratio);
      for (const Vec2& shift : mesh.period.shifts(surface.lower(), surface.upper())) {
        // A point of the surface itself has a value.
        if (!(surface.distance(x - shift) < -1e-6 * (surface.upper() - surface.lower()).norm())) continue;
        findings.warn(
            where,
            "the probe \"{}\" at ({:g}, {:g}) m lies in the body \"{}\": it has no value {}; move it "
            "into the fluid",
            name, x.x(), x.y(), body.name, body.changes_place() ? "until the body has gone" : "at all");
      }
    }
  };
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    check("probe", i, "point", scene.probes[i].name, scene.probes[i].point);
    check("probe", i, "minus", scene.probes[i].name, scene.probes[i].minus);
  }
  for (std::size_t i = 0; i < scene.profiles.size(); ++i) {
    check("profile", i, "from", scene.profiles[i].name, scene.profiles[i].from);
    check("profile", i, "to", scene.profiles[i].name, scene.profiles[i].to);
  }
}

proto::Figures step_figures(const scene::Scene& scene, const NavierStokes& solver) {
  proto::Figures figures;
  for (const scene::Probe& p : scene.probes)
    if (const auto value = read(solver, p)) figures.emplace_back(p.name, *value);  // a body may cover it
  for (std::size_t b = 0; b < solver.boundary_tractions().size(); ++b) {
    const std::string& name = solver.boundary_curves()[b].name;
    const BoundaryTraction& traction = solver.boundary_tractions()[b];
    figures.emplace_back("force_x:" + name, scene.thickness * traction.force.x());
    figures.emplace_back("force_y:" + name, scene.thickness * traction.force.y());
    figures.emplace_back("torque:" + name, scene.thickness * traction.torque);
  }
  for (const auto& [name, size] : solver.found_drives()) figures.emplace_back(name, size);
  return figures;
}

proto::Figures balance_figures(double thickness, const ForceBalance& balance) {
  proto::Figures figures;
  for (const auto& [name, force] : balance.terms) {
    figures.emplace_back("balance_x:" + name, thickness * force.x());
    figures.emplace_back("balance_y:" + name, thickness * force.y());
  }
  figures.emplace_back("balance:rest", balance.relative());
  return figures;
}

proto::Figures volume_figures(double thickness, const VolumeBalance& balance) {
  proto::Figures figures;
  for (const auto& [name, inflow] : balance.terms) figures.emplace_back("volume:" + name, thickness * inflow);
  figures.emplace_back("volume:rest", thickness * balance.rest());
  return figures;
}

proto::Figures final_figures(const scene::Scene& scene, const NavierStokes& solver) {
  proto::Figures figures;
  for (const BoundaryCurve& curve : solver.boundary_curves()) {
    figures.emplace_back("centre_x:" + curve.name, curve.centre.x());
    figures.emplace_back("centre_y:" + curve.name, curve.centre.y());
  }
  for (const scene::Profile& p : scene.profiles)
    if (const auto profile = measure(solver, p)) {
      add_extremum("min", p.name, profile->smallest, figures);
      add_extremum("max", p.name, profile->largest, figures);
    }
  if (scene.exact) {
    const FlowErrors e = errors(*scene.exact, solver);
    figures.emplace_back("error:velocity_l2", e.velocity_l2);
    figures.emplace_back("error:velocity_h1", e.velocity_h1);
    figures.emplace_back("error:pressure_l2", e.pressure_l2);
  }
  return figures;
}

std::vector<proto::Curve> boundary_curves(const NavierStokes& solver) {
  std::vector<proto::Curve> out;
  for (std::size_t b = 0; b < solver.boundary_tractions().size(); ++b) {
    const BoundaryCurve& curve = solver.boundary_curves()[b];
    proto::Curve& wire = out.emplace_back(proto::Curve{.name = curve.name, .components = 2});
    for (const Index node : curve.nodes) {
      const Vec2 x = solver.mesh().node_position(node);
      wire.points.insert(wire.points.end(), {x.x(), x.y(), 0});
    }
    for (const auto& line : curve.lines) wire.lines.insert(wire.lines.end(), line.begin(), line.end());
    for (const Vec2& t : solver.boundary_tractions()[b].values)
      wire.values.insert(wire.values.end(), {t.x(), t.y()});
  }
  return out;
}

std::vector<proto::Curve> profile_curves(const scene::Scene& scene, const NavierStokes& solver) {
  std::vector<proto::Curve> out;
  for (const scene::Profile& p : scene.profiles) {
    const auto profile = measure(solver, p);
    if (!profile) continue;
    proto::Curve& wire = out.emplace_back(proto::Curve{.name = p.name});
    for (const ProfilePoint& point : profile->points) {
      wire.points.insert(wire.points.end(), {point.place.x(), point.place.y(), 0});
      wire.values.push_back(point.value);
    }
  }
  return out;
}

}  // namespace fpi::fluid
