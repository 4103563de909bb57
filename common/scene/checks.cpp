/// What must hold between the groups of a scene.
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "scene/scene.hpp"

namespace fpi::scene {
namespace {

constexpr std::array<std::string_view, 4> rectangle_sides{"left", "right", "bottom", "top"};
constexpr std::array<std::string_view, 13> history_columns{"time",
                                                           "step",
                                                           "sub_iterations",
                                                           "residual_velocity",
                                                           "residual_force",
                                                           "newton_iterations",
                                                           "columns_kept",
                                                           "columns_dropped",
                                                           "displacement",
                                                           "miss",
                                                           "recuts",
                                                           "drag",
                                                           "lift"};

/// " (did you mean \"steel\"?)", or the whole list where nothing is near.
template <class Range>
std::string hint(std::string_view word, const Range& candidates) {
  const std::string near = did_you_mean(word, candidates);
  if (!near.empty()) return fmt::format(" (did you mean \"{}\"?)", near);
  return fmt::format(" ({})", fmt::join(candidates, ", "));
}

template <class Group>
std::vector<std::string> names_of(const std::vector<Group>& groups) {
  std::vector<std::string> names;
  for (const Group& group : groups) names.push_back(group.name);
  return names;
}

std::string key_of(std::string_view list, std::size_t index, std::string_view key) {
  return fmt::format("{}.{}.{}", list, index, key);
}

/// Names become columns and HDF5 paths, so they are plain words.
bool is_plain(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}
constexpr std::string_view plain_word = "must be a word of letters a-z, digits, _ and -";

template <class Group>
void check_names(std::string_view list, const std::vector<Group>& groups, ParameterVisitor& v) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string& name = groups[i].name;
    v.require(is_plain(name), key_of(list, i, "name"), plain_word);
    v.require(seen.insert(name).second, key_of(list, i, "name"),
              fmt::format("must be unique among [[{}]]", list));
  }
}

/// Groups and bodies have columns of history.csv by their names.
void check_group_names(const Scene& scene, ParameterVisitor& v) {
  const std::vector<std::string> bodies = names_of(scene.bodies);
  for (std::size_t i = 0; i < scene.grains.size(); ++i)
    v.require(std::ranges::find(bodies, scene.grains[i].name) == bodies.end(), key_of("grains", i, "name"),
              "must not be the name of a body");
}

template <class Group>
void check_materials(std::string_view list, const std::vector<Group>& groups, const Scene& scene,
                     ParameterVisitor& v) {
  const std::vector<std::string> materials = names_of(scene.materials);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string& material = groups[i].material;
    const bool known = material.empty() || std::ranges::find(materials, material) != materials.end();
    if (known) continue;
    v.require(false, key_of(list, i, "material"),
              "must name one of [[materials]]" + hint(material, materials));
  }
}

void check_wall(const Wall& wall, std::size_t axes, const std::string& all_axes, std::size_t i,
                ParameterVisitor& v) {
  const bool plane = axes == 2, mesh = wall.shape == "mesh";
  v.require(wall.shape == "plane" || mesh != plane, key_of("walls", i, "shape"),
            plane ? "must be \"plane\", \"polyline\" or \"arc\" in a plane scene"
                  : "must be \"plane\" or \"mesh\" in space");
  const auto entries = [&](std::size_t size, bool may_be_empty, std::string_view key) {
    v.require(size == axes || (may_be_empty && size == 0), key_of("walls", i, key), all_axes);
  };
  entries(wall.point.size(), wall.shape != "plane", "point");
  entries(wall.normal.size(), wall.shape != "plane", "normal");
  entries(wall.centre.size(), wall.shape != "arc", "centre");
  entries(wall.velocity.size(), true, "velocity");
  v.require(!plane || wall.spin.size() == 1, key_of("walls", i, "spin"),
            "must have one entry in a plane scene");
  v.require(wall.normal.empty() || std::ranges::any_of(wall.normal, [](double n) { return n != 0; }),
            key_of("walls", i, "normal"), "must not be zero");
}

template <class Group>
void check_shapes(std::string_view list, const std::vector<Group>& groups, bool plane, std::string_view first,
                  const Scene& scene, ParameterVisitor& v) {
  // The DEM's part of a scene knows the fluid by its viscosity only.
  const bool has_liquid = scene.fluid || (scene.dem && scene.dem->lubrication.viscosity);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    v.require(groups[i].motion != "free" || groups[i].density > 0 || has_liquid, key_of(list, i, "density"),
              "must be > 0 kg/m³ of a free body where there is no fluid to move");
    v.require(groups[i].is_plane() == plane, key_of(list, i, "shape"),
              fmt::format("must go with the first body's, \"{}\": a scene is plane or in space", first));
    v.require(!scene.fluid || groups[i].is_plane(), key_of(list, i, "shape"),
              "must be \"disc\" or \"polygon\" where there is a [fluid], which is plane");
    const bool is_held = groups[i].motion != "free";  // its motion is refused otherwise
    v.require(groups[i].shape != "polygon" || !is_held || !scene.moves_freely(), key_of(list, i, "shape"),
              "must not be \"polygon\" where other bodies move freely: there is no contact law for polygons "
              "yet");
  }
}

void check_dimensions(const Scene& scene, ParameterVisitor& v) {
  if (scene.bodies.empty() && scene.grains.empty()) return;
  const std::string& first = scene.bodies.empty() ? scene.grains[0].shape : scene.bodies[0].shape;
  const bool plane = first != "sphere";
  check_shapes("bodies", scene.bodies, plane, first, scene, v);
  check_shapes("grains", scene.grains, plane, first, scene, v);
  const std::size_t axes = plane ? 2 : 3;
  const std::string all_axes = fmt::format("must have {} entries, as the bodies are {}s", axes, first);
  v.require(axes == 3 || scene.gravity.size() == axes, "gravity", all_axes);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) check_wall(scene.walls[i], axes, all_axes, i, v);
  for (std::size_t i = 0; i < scene.outlets.size(); ++i)
    v.require(scene.outlets[i].lower.size() == axes, key_of("outlets", i, "lower"), all_axes);
}

/// Whether both corners are there: another check says so where they are not.
bool is_rectangle(const Mesh& mesh) {
  return mesh.file.empty() && mesh.lower.size() == 2 && mesh.upper.size() == 2;
}

/// The sides of a rectangle that lie in the planes across a periodic axis are no boundaries.
void check_periodic_rectangle(const Scene& scene, int axis, ParameterVisitor& v) {
  const Mesh& mesh = scene.fluid->mesh;
  if (mesh.lower.size() != 2 || mesh.upper.size() != 2) return;  // no rectangle: the mesh tells of it
  v.require(
      scene.periodic.along(axis) == std::vector{mesh.lower[axis], mesh.upper[axis]},
      axis == 0 ? "periodic.x" : "periodic.y",
      fmt::format("must be the sides of the rectangle, [{:g}, {:g}]", mesh.lower[axis], mesh.upper[axis]));
  for (const std::size_t side : {0, 1}) {
    const std::string name(rectangle_sides[2 * axis + side]);
    v.require(!scene.fluid->boundaries.contains(name), "fluid.boundaries." + name,
              fmt::format("is no boundary where the scene is periodic along {}: remove the table",
                          axis == 0 ? "x" : "y"));
  }
}

void check_periods(const Scene& scene, ParameterVisitor& v) {
  v.require(
      scene.fluid->superficial_velocity.empty() || !scene.periodic.x.empty() || !scene.periodic.y.empty(),
      "fluid.superficial_velocity", "goes with [periodic] only: give a boundary a flow_rate");
  const auto& superficial = scene.fluid->superficial_velocity;
  if (superficial.size() == 1) return;  // the fluid tells of it
  for (const int axis : {0, 1}) {
    const bool periodic = !scene.periodic.along(axis).empty();
    v.require(periodic || scene.fluid->pressure_drop[axis] == "0", "fluid.pressure_drop",
              fmt::format("must be 0 along {}, which is not periodic: give [periodic], or a traction at the "
                          "boundary",
                          axis == 0 ? "x" : "y"));
    v.require(periodic || superficial.size() != 2 || superficial[axis] == "0", "fluid.superficial_velocity",
              fmt::format("must be 0 along {}, which is not periodic: give [periodic], or a flow_rate at the "
                          "boundary",
                          axis == 0 ? "x" : "y"));
    v.require(superficial.empty() || scene.fluid->pressure_drop[axis] == "0", "fluid.pressure_drop",
              "must be left out where superficial_velocity is given: it is found");
    if (periodic && is_rectangle(scene.fluid->mesh)) check_periodic_rectangle(scene, axis, v);
  }
}

void check_boundaries(const Scene& scene, ParameterVisitor& v) {
  const std::vector<std::string> bodies = names_of(scene.bodies);
  for (const auto& [name, boundary] : scene.fluid->boundaries) {
    const std::string key = fmt::format("fluid.boundaries.{}", name);
    v.require(name.find_first_of(",/\"\n\r") == std::string::npos, key,
              "has a name that must be without commas, slashes and quotes: rename it in the mesh");
    v.require(std::ranges::find(bodies, name) == bodies.end(), key,
              "must not have the name of a body: both are columns of history.csv");
  }
  if (!scene.fluid->mesh.file.empty()) return;  // the mesh file names its own; the fluid checks those
  for (const auto& [name, boundary] : scene.fluid->boundaries) {
    if (std::ranges::find(rectangle_sides, name) != rectangle_sides.end()) continue;
    v.require(false, "fluid.boundaries." + name,
              "is not a side of the rectangle" + hint(name, rectangle_sides));
  }
  for (std::size_t i = 0; i < rectangle_sides.size(); ++i) {
    if (!scene.periodic.along(static_cast<int>(i / 2)).empty()) continue;
    const std::string_view side = rectangle_sides[i];
    v.require(scene.fluid->boundaries.contains(std::string(side)), fmt::format("fluid.boundaries.{}", side),
              "must have a condition: add a table with its type");
  }
}

void check_coefficients(const Scene& scene, ParameterVisitor& v) {
  if (scene.coefficients.empty()) return;
  v.require(scene.fluid.has_value(), "coefficients", "must go with a [fluid]");
  if (scene.coefficients.size() > 1) check_names("coefficients", scene.coefficients, v);
  std::vector<std::string> names = names_of(scene.bodies);
  if (scene.fluid) {
    for (const auto& [name, boundary] : scene.fluid->boundaries) {
      if (boundary.holds_fluid()) names.push_back(name);
    }
  }
  for (std::size_t i = 0; i < scene.coefficients.size(); ++i) {
    const Coefficients& c = scene.coefficients[i];
    v.require(c.name.empty() || is_plain(c.name), key_of("coefficients", i, "name"), plain_word);
    if (std::ranges::find(names, c.on) != names.end()) continue;
    v.require(false, key_of("coefficients", i, "on"),
              "must name a body or a boundary that holds the fluid" + hint(c.on, names));
  }
}

void check_measurements(const Scene& scene, ParameterVisitor& v) {
  v.require(scene.profiles.empty() || scene.fluid, "profiles", "must go with a [fluid]");
  v.require(!scene.exact || scene.fluid, "exact", "must go with a [fluid]");
  v.require(scene.time.steady || !scene.output.measure_from || *scene.output.measure_from < scene.time.end,
            "output.measure_from", "must be before the end of the run (time.end)");
}

void check_probes(const Scene& scene, ParameterVisitor& v) {
  v.require(scene.probes.empty() || scene.fluid, "probes", "must go with a [fluid]");
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const bool taken = std::ranges::find(history_columns, scene.probes[i].name) != history_columns.end();
    v.require(!taken, key_of("probes", i, "name"), "must not be the name of another column of history.csv");
  }
}

void check_motion(const Scene& scene, ParameterVisitor& v) {
  v.require(scene.fluid || scene.moves_freely(), "fluid",
            "must be there where no body is free: nothing would happen");
  v.require(scene.outlets.empty() || scene.moves_freely(), "outlets", "must go with bodies that move freely");
  v.require(!scene.time.steady || !scene.moves_freely(), "time.steady",
            "must be false where bodies move freely");
  v.require(!scene.time.steady || scene.fluid, "time.steady", "must go with a [fluid]");
  v.require(scene.time.relative_tolerance == 0 || scene.fluid, "time.relative_tolerance",
            "must go with a [fluid], which estimates the error");
  v.require(scene.time.max_displacement == 0 || scene.fluid, "time.max_displacement",
            "must go with a [fluid], whose elements it counts in");
  const bool can_touch =
      scene.moves_freely() && (scene.walls.size() > 0 || scene.bodies.size() > 1 || !scene.grains.empty());
  v.require(!can_touch || !scene.materials.empty(), "materials",
            "must have an entry where free bodies can touch walls or each other");
}

/// A material must say how stiff it is, by the law of the scene's contacts.
void check_stiffness(const Scene& scene, ParameterVisitor& v) {
  const bool linear = scene.dem && scene.dem->contact == "linear";
  const std::string_view key = linear ? "normal_stiffness" : "youngs_modulus";
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    v.require((linear ? m.normal_stiffness : m.youngs_modulus) > 0, key_of("materials", i, key),
              linear ? "must be > 0 N/m where dem.contact = \"linear\""
                     : "must be > 0 Pa where dem.contact = \"hertz\"");
  }
}

}  // namespace

void Scene::check(ParameterVisitor& v) const {
  check_names("bodies", bodies, v);
  check_names("grains", grains, v);
  check_group_names(*this, v);
  check_names("materials", materials, v);
  check_names("walls", walls, v);
  check_names("outlets", outlets, v);
  check_stiffness(*this, v);
  check_names("probes", probes, v);
  check_materials("bodies", bodies, *this, v);
  check_materials("grains", grains, *this, v);
  check_materials("walls", walls, *this, v);
  check_dimensions(*this, v);
  if (fluid) {
    check_periods(*this, v);
    check_boundaries(*this, v);
  }
  check_coefficients(*this, v);
  check_motion(*this, v);
  check_probes(*this, v);
  check_names("profiles", profiles, v);
  check_measurements(*this, v);
}

}  // namespace fpi::scene
