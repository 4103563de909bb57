#include "dem/model/model.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "dem/walls/wall_images.hpp"

namespace fpi::dem {
namespace {

Vec3 to_eigen(const std::vector<double>& v) {
  const scene::Vec3 a = scene::to_vec3(v);
  return {a[0], a[1], a[2]};
}

Vec3 spin_of(const scene::Body& body) {
  const scene::Vec3 a = scene::spin_to_vec3(body.spin);
  return {a[0], a[1], a[2]};
}

std::size_t material_index(const Problem& problem, const std::string& owner, const std::string& name) {
  const auto& materials = problem.materials;
  const bool alone = problem.bodies.size() == 1 && problem.walls.empty();
  if (name.empty() && (alone || !materials.empty())) return 0;
  const auto found = std::ranges::find(materials, name, &scene::Material::name);
  require(found != materials.end(), "a material for {} is required; got \"{}\": add it to [[materials]]",
          owner, name);
  return static_cast<std::size_t>(found - materials.begin());
}

void add_body(const Problem& problem, const scene::Body& body, Bodies& bodies) {
  const double R = body.radius;
  require(std::isfinite(R) && R > 0, "body {} must have a radius > 0 m; got {}", body.name, R);
  const double mass = body.density * body.volume(R, problem.thickness);
  require(!body.is_free() || (std::isfinite(mass) && mass >= 0),
          "free body {} must have a mass ≥ 0 kg; got {} kg from density {} kg/m³: give it a density, or make "
          "it fixed or prescribed",
          body.name, mass, body.density);
  const double inertia = (body.shape == "disc" ? 0.5 : 0.4) * mass * R * R;
  bodies.name.push_back(body.name);
  bodies.radius.push_back(R);
  bodies.mass.push_back(mass);
  bodies.inertia.push_back(inertia);
  bodies.inverse_mass.push_back(body.is_free() ? 1 / mass : 0);
  bodies.inverse_inertia.push_back(body.is_free() && body.rotates ? 1 / inertia : 0);
  bodies.left.push_back(false);
  bodies.material.push_back(material_index(problem, "body " + body.name, body.material));
}

std::vector<Facet> facets_of(const Problem& problem, const scene::Wall& wall) {
  if (wall.shape == "polyline") return polyline(wall.vertices, wall.closed);
  if (wall.shape == "arc") return arc(to_eigen(wall.centre), wall.radius, wall.start, wall.end);
  if (wall.shape == "mesh") {
    const auto found = problem.meshes.find(wall.file);
    require(found != problem.meshes.end(), "the triangles of {} are required for wall {}; got none",
            wall.file, wall.name);
    return mesh(found->second, wall.scale);
  }
  const Vec3 normal = to_eigen(wall.normal), point = to_eigen(wall.point);
  const double length = normal.norm();
  require(std::isfinite(length) && length > 0 && point.allFinite(),
          "wall {} must have a finite point and a normal that is not zero; got length {}", wall.name, length);
  return {Plane{normal / length, point.dot(normal) / length}};
}

void add_wall(const Problem& problem, const scene::Wall& wall, Walls& walls) {
  std::vector<Facet> facets = facets_of(problem, wall);
  require(!facets.empty(), "wall {} must have a facet with an area; got none in {}", wall.name, wall.file);
  walls.add({.name = wall.name,
             .material = material_index(problem, "wall " + wall.name, wall.material),
             .moves = wall.moves(),
             .centre = to_eigen(wall.centre)},
            std::move(facets));
}

/// How far [m] the fastest body flies in the whole run where nothing stops it.
double free_flight(const Problem& problem) {
  double fastest = 0;
  for (const scene::Body& body : problem.bodies) fastest = std::max(fastest, to_eigen(body.velocity).norm());
  return problem.duration * (fastest + 0.5 * problem.duration * problem.gravity.norm());
}

/// The box around all bodies and walls at the start, of planes their points, and farther on every side by
/// dem.lost_distance.
Box expected_places(const Problem& problem, const Walls& walls) {
  constexpr double farther = 1000;  // diagonals, where no distance is set and nothing flies farther by itself
  Box box;
  for (const scene::Body& body : problem.bodies) {
    const Vec3 x = to_eigen(body.position), reach = Vec3::Constant(body.radius);
    box.extend(Box(x - reach, x + reach));
  }
  for (const scene::Wall& wall : problem.walls)
    if (wall.shape == "plane") box.extend(to_eigen(wall.point));
  for (const Facet& facet : walls.facets)
    if (const Box around = bounds(facet); around.sizes().allFinite()) box.extend(around);
  const double asked = problem.dem.lost_distance;
  const Vec3 margin = Vec3::Constant(
      asked > 0 ? asked : std::max(farther * box.diagonal().norm(), 1.01 * free_flight(problem)));
  return {box.min() - margin, box.max() + margin};
}

/// Twice as wide as the largest grains, or two grains would touch each other through both sides.
PeriodicBox make_box(const Problem& problem) {
  PeriodicBox box;
  double largest = 0;
  for (const scene::Body& body : problem.bodies) largest = std::max(largest, body.radius);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& planes = problem.periodic.along(axis);
    if (planes.empty()) continue;
    box.lower[axis] = planes[0];
    box.length[axis] = planes[1] - planes[0];
    require(box.length[axis] > 4.04 * largest,
            "periodic.{} must be wider than two of the largest grains; got {:g} m for grains of {:g} m: make "
            "the box wider, or put more grains in it",
            "xyz"[axis], box.length[axis], 2 * largest);
  }
  return box;
}

void check_body(const Problem& problem, const scene::Body& body) {
  const scene::Body& first = problem.bodies[0];
  require(body.shape == first.shape, "body {} must be a {}, as the first body is; got a {}", body.name,
          first.shape, body.shape);
  const Vec3 x = to_eigen(body.position), v = to_eigen(body.velocity), spin = spin_of(body);
  require(x.allFinite() && v.allFinite() && spin.allFinite(),
          "body {} must start with a finite position, velocity and spin", body.name);
  require(body.shape != "disc" || (x.z() == 0 && v.z() == 0 && spin.x() == 0 && spin.y() == 0),
          "disc {} must move in the plane z = 0 and spin about z; use shape = \"sphere\" in space",
          body.name);
}

/// Everything but bodies that would leave the plane z = 0 of a scene of discs.
void check_plane(const Problem& problem, Findings& wrong) {
  if (!problem.periodic.z.empty())
    wrong.error("periodic.z", "periodic.z goes with spheres; got discs: remove it");
  if (problem.gravity.z() != 0)
    wrong.error("gravity", "gravity of a plane scene must have z = 0; got {}", problem.gravity.z());
  for (std::size_t i = 0; i < problem.walls.size(); ++i)
    if (to_eigen(problem.walls[i].normal).z() != 0)
      wrong.error(fmt::format("walls.{}.normal", i), "wall {} of a plane scene must have a normal in x, y",
                  problem.walls[i].name);
}

}  // namespace

Model make_model(const Problem& problem, Findings& wrong) {
  Model model;
  if (problem.bodies.empty()) {
    wrong.error("bodies", "a DEM scene must have a body; got none: add [[bodies]]");
    return model;
  }
  if (!problem.gravity.allFinite()) wrong.error("gravity", "gravity must be finite");
  model.plane = problem.bodies[0].shape == "disc";
  if (model.plane) check_plane(problem, wrong);
  model.gravity = problem.gravity;
  model.steps_per_contact = problem.dem.steps_per_contact;
  model.largest_sub_step = problem.dem.largest_sub_step > 0 ? problem.dem.largest_sub_step
                                                            : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < problem.bodies.size(); ++i)
    wrong.attempt(fmt::format("bodies.{}", i), [&] {
      check_body(problem, problem.bodies[i]);
      add_body(problem, problem.bodies[i], model.bodies);
    });
  wrong.attempt("periodic", [&] { model.periodic = make_box(problem); });
  for (std::size_t i = 0; i < problem.walls.size(); ++i)
    wrong.attempt(fmt::format("walls.{}", i), [&] {
      const scene::Wall& wall = problem.walls[i];
      add_wall(problem, wall, model.walls);
      const Wall& added = model.walls.walls.back();
      check_fit(model.periodic, added, std::span(model.walls.facets).subspan(added.first_facet), wall);
    });
  if (wrong.has_errors()) return model;
  model.elasticity = problem.dem.contact == "linear" ? Elasticity::linear : Elasticity::hertz;
  model.laws = LawTable(stretched(problem.materials, problem.dem.stretch), model.elasticity);
  const scene::Lubrication& lubrication = problem.dem.lubrication;
  model.lubricant = {lubrication.viscosity.value_or(0) * (model.plane ? problem.thickness : 1),
                     lubrication.roughness, problem.hydraulic_radius_ratio};
  model.near_field = problem.dem.near_field;
  model.adhesion_range = problem.dem.adhesion_range;
  model.accounts_energy = problem.dem.energy;
  model.stretch = problem.dem.stretch;
  model.implicit = problem.dem.scheme == "trapezoidal";
  model.loads_are_linear = problem.dem.loads == "linear";
  model.start_overlap = problem.dem.start_overlap;
  model.expected = expected_places(problem, model.walls);
  return model;
}

Model make_model(const Problem& problem) {
  Findings wrong;
  Model model = make_model(problem, wrong);
  wrong.raise();
  return model;
}

Motions initial_motions(const Problem& problem) {
  Motions motions;
  for (const auto& body : problem.bodies) {
    motions.position.push_back(to_eigen(body.position));
    motions.velocity.push_back(to_eigen(body.velocity));
    motions.spin.push_back(spin_of(body));
  }
  motions.orientation.resize(problem.bodies.size());
  return motions;
}

}  // namespace fpi::dem
