#include "grains/expand.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "core/error.hpp"
#include "grains/lattice.hpp"
#include "grains/outlet_fit.hpp"
#include "grains/packing.hpp"
#include "grains/radii.hpp"
#include "grains/start.hpp"
#include "grains/table.hpp"

namespace fpi::grains {
namespace {

constexpr double most_grains = 1e7;  ///< in a group: more are a mistake in a unit

Box box_of(const scene::Grains& group, const scene::Periodic& periodic) {
  Box box{.lower = scene::to_vec3(group.lower),
          .upper = scene::to_vec3(group.upper),
          .axes = group.axes(),
          .periods = {}};
  for (std::size_t k = 0; k < group.lower.size(); ++k) {
    const std::vector<double>& planes = periodic.along(static_cast<int>(k));
    if (planes == std::vector{group.lower[k], group.upper[k]}) box.periods[k] = planes[1] - planes[0];
  }
  return box;
}

void check_number(const scene::Grains& group, double expected) {
  require(expected <= most_grains,
          "[[grains]] \"{}\" must stand for at most {:g} grains; got about {:.3g}: make the box smaller or "
          "the grains larger",
          group.name, most_grains, expected);
}

template <class T>
void shuffle(std::vector<T>& items, std::mt19937_64& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
}

std::vector<Row> with_radii(const std::vector<Vec3>& centres, const std::vector<double>& radii) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < centres.size(); ++i) rows.push_back({.sphere = {centres[i], radii[i]}});
  return rows;
}

std::vector<Row> on_lattice(const scene::Grains& group, const Box& box) {
  const double largest = group.largest_radius();
  const double spacing = group.spacing > 0 ? group.spacing : 2 * largest + group.gap;
  check_number(group, box.volume() / std::pow(spacing, static_cast<double>(box.axes)));
  const std::vector<Vec3> centres = lattice(group.generator, box, spacing, largest);
  std::vector<double> radii = radii_of_count(size_classes(group), box.axes, centres.size());
  std::mt19937_64 random(static_cast<std::uint64_t>(group.seed));
  shuffle(radii, random);
  return with_radii(centres, radii);
}

/// Discs and spheres that are there already; polygons are seen as the smallest disc around them.
std::vector<Sphere> obstacles(const scene::Scene& scene) {
  std::vector<Sphere> spheres;
  for (const scene::Body& body : scene.bodies) spheres.push_back(sphere_around(body));
  return spheres;
}

std::vector<Row> at_random(const scene::Grains& group, const Box& box, const scene::Scene& scene) {
  const double volume = group.solid_fraction * box.volume();
  const std::vector<SizeClass> classes = size_classes(group);
  check_number(group, volume * number_density(classes, box.axes));
  const std::vector<double> radii = radii_of_volume(classes, box.axes, volume);
  require(!radii.empty(),
          "[[grains]] \"{}\" must have room for a grain; got a box for less than half of one at "
          "solid_fraction = {}",
          group.name, group.solid_fraction);
  const auto centres = pack(box, radii, group.gap, obstacles(scene), static_cast<std::uint64_t>(group.seed));
  require(centres.has_value(),
          "[[grains]] \"{}\" must have a solid_fraction at which {} grains fit between the sides of the box; "
          "at {} they jam "
          "(equal discs near 0.84, spheres near 0.64, less beside walls and with a gap): lower it, or drop a "
          "lattice under gravity",
          group.name, radii.size(), group.solid_fraction);
  return with_radii(*centres, radii);
}

std::vector<Row> rows_of(const scene::Grains& group, const scene::Scene& scene, const Content& content) {
  Table table;
  if (group.is_table()) {
    table = read_table(content(group.file), group.file, group.axes());
  } else {
    const Box box = box_of(group, scene.periodic);
    table.rows = group.is_random() ? at_random(group, box, scene) : on_lattice(group, box);
    require(!table.rows.empty(), "[[grains]] \"{}\" must have room for a grain; got a box narrower than one",
            group.name);
  }
  for (Row& row : table.rows) {
    if (!table.has_velocity) row.velocity = scene::to_vec3(group.velocity);
    if (!table.has_spin) row.spin = scene::spin_to_vec3(group.spin);
  }
  return table.rows;
}

scene::Body body_of(const scene::Grains& group, std::size_t number, const Row& row) {
  const auto entries = [&group](const Vec3& v) {
    return std::vector<double>(v.begin(), v.begin() + group.axes());
  };
  scene::Body body;
  body.name = fmt::format("{}.{}", group.name, number);
  body.shape = group.shape;
  body.radius = row.sphere.radius;
  body.density = group.density;
  body.position = entries(row.sphere.centre);
  body.velocity = entries(row.velocity);
  body.spin = group.is_plane() ? std::vector{row.spin[2]} : entries(row.spin);
  body.motion = group.motion;
  body.prescribed_velocity = group.prescribed_velocity;
  body.prescribed_spin = group.prescribed_spin;
  body.material = group.material;
  return body;
}

}  // namespace

Findings place(scene::Scene& scene, const Content& content) {
  Findings findings;
  for (std::size_t g = 0; g < scene.grains.size(); ++g)
    findings.attempt(fmt::format("grains.{}", g), [&] {
      scene::Grains& group = scene.grains[g];
      const std::vector<Row> rows = rows_of(group, scene, content);
      for (const Row& row : rows) scene.bodies.push_back(body_of(group, group.count++, row));
    });
  if (findings.has_errors()) return findings;
  findings.append(start_findings(scene).all());
  findings.attempt("outlets", [&] { check_outlets(scene); });
  return findings;
}

void expand(scene::Scene& scene, const Content& content) { place(scene, content).raise(); }

std::vector<std::string> describe(const scene::Scene& scene) {
  std::vector<std::string> lines;
  auto first = scene.bodies.begin() + static_cast<std::ptrdiff_t>(scene.n_listed());
  for (const scene::Grains& group : scene.grains) {
    const auto last = first + static_cast<std::ptrdiff_t>(group.count);
    const auto [smallest, largest] = std::ranges::minmax_element(first, last, {}, &scene::Body::radius);
    std::string line = fmt::format("{}: {} {}s, radius {:g} to {:g} m", group.name, group.count, group.shape,
                                   smallest->radius, largest->radius);
    if (!group.is_table()) {
      double volume = 0;
      for (auto body = first; body != last; ++body) volume += body->volume(body->radius, 1);
      line += fmt::format(", {:.4g} of their box", volume / box_of(group, {}).volume());
    }
    lines.push_back(line);
    first = last;
  }
  return lines;
}

}  // namespace fpi::grains
