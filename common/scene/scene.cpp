#include "scene/scene.hpp"

#include <algorithm>
#include <utility>

#include "core/hash.hpp"

namespace fpi::scene {

/// Plain keys first: in TOML whatever follows a table's header belongs to that table.
void Scene::declare(ParameterVisitor& v) {
  v.text({"title", "", "one line that says what the scene shows"}, title);
  v.text({"source", "", "where the set-up comes from"}, source);
  v.text({"expected", "", "what should come out, and who says so"}, expected);
  v.reals({"gravity", "m/s²", "g: two entries in a plane scene, three in space"}, gravity, {2, 3},
          any_number());
  v.real({"thickness", "m", "thickness of a plane scene; masses and forces are those of this slice"},
         thickness, positive());
  v.real({"hydraulic_radius_ratio", "",
          "radius that the fluid sees over the contact radius; below 1 touching discs let fluid "
          "through; polygons keep their size"},
         hydraulic_radius_ratio, above_up_to(0, 1));
  v.table({"time", "", "the time steps", true}, time);
  v.table({"periodic", "", "planes through which everything repeats itself, flow and contacts"}, periodic);
  v.table({"fluid", "", "the flow; without it the grains are dry and no fluid program is started"}, fluid);
  v.table({"dem", "", "how the grains' motion is integrated"}, dem);
  v.tables({"bodies", "", "discs and polygons (plane) or spheres (space), one table each"}, bodies);
  v.tables({"grains", "", "groups of discs or spheres that are placed by a rule, or by a table"}, grains);
  v.tables({"materials", "", "what bodies and walls are made of, for their contacts"}, materials);
  v.tables({"walls", "", "what stops the grains, at rest or moving; the fluid does not see walls"}, walls);
  v.tables({"outlets", "", "boxes in which free bodies leave the scene, are counted and taken out"}, outlets);
  v.table({"coupling", "", "the implicit staggered iteration of each time step"}, coupling);
  v.table({"output", "", "what is written, and how often"}, output);
  v.tables(
      {"coefficients", "",
       "drag and lift coefficients c = 2F/(ρ U² L) of a body or a boundary; a single table [coefficients] "
       "will do"},
      coefficients);
  v.tables({"probes", "", "values at points, written with every step"}, probes);
  v.tables({"profiles", "", "quantities along segments, with their extrema, written with the fields"},
           profiles);
  v.table({"percolation", "", "what is wanted of a flow through grains: see docs/percolation.md"},
          percolation);
  v.table({"exact", "", "the exact solution, where it is known: errors are reported at the end"}, exact);
  check(v);
}

std::size_t Scene::n_listed() const {
  std::size_t n = bodies.size();
  for (const Grains& group : grains) n -= group.count;
  return n;
}

bool Scene::moves_freely() const {
  return std::ranges::any_of(bodies, &Body::is_free) || std::ranges::any_of(grains, &Grains::is_free);
}

bool Scene::moves() const {
  return std::ranges::any_of(bodies, &Body::changes_place) ||
         std::ranges::any_of(grains, &Grains::changes_place);
}

Scene part_of(Part part, const Scene& scene) {
  // Materials and the contact law stay on both sides, so that the bodies' references hold, and what they may
  // overlap by at the start.
  Scene p = scene;
  p.coupling = {};
  p.output = {};
  p.outlets.clear();
  if (part == Part::fluid) {
    p.walls.clear();
  } else {
    if (p.fluid) {
      if (!p.dem) p.dem.emplace();
      auto& viscosity = p.dem->lubrication.viscosity;
      viscosity = viscosity.value_or(p.fluid->viscosity());
    }
    p.fluid.reset();
    p.time.relative_tolerance = 0;
    p.time.max_displacement = 0;
    p.time.wanted_sub_iterations = 0;
    p.coefficients.clear();
    p.probes.clear();
    p.profiles.clear();
    p.percolation.reset();
    p.exact.reset();
  }
  return p;
}

std::vector<std::pair<std::string, std::string*>> file_keys(Scene& scene) {
  std::vector<std::pair<std::string, std::string*>> keys;
  const auto add = [&keys](std::string key, std::string& name) {
    if (!name.empty()) keys.emplace_back(std::move(key), &name);
  };
  if (scene.fluid) add("fluid.mesh.file", scene.fluid->mesh.file);
  for (std::size_t i = 0; i < scene.grains.size(); ++i)
    add("grains." + std::to_string(i) + ".file", scene.grains[i].file);
  for (std::size_t i = 0; i < scene.walls.size(); ++i)
    add("walls." + std::to_string(i) + ".file", scene.walls[i].file);
  return keys;
}

std::vector<std::string*> file_names(Scene& scene) {
  std::vector<std::string*> names;
  for (const auto& [key, name] : file_keys(scene)) names.push_back(name);
  return names;
}

std::uint64_t fingerprint(const Scene& scene) {
  Scene decisive = scene;
  decisive.title.clear();
  decisive.source.clear();
  decisive.expected.clear();
  if (decisive.fluid) decisive.fluid->launch = {};
  if (!decisive.dem) decisive.dem.emplace();
  decisive.dem->launch = {};
  decisive.coupling.participant_timeout = Coupling().participant_timeout;
  decisive.output.checkpoint_interval = Output().checkpoint_interval;
  return fnv1a(write_text(decisive));
}

}  // namespace fpi::scene
