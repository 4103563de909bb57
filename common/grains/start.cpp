#include "grains/start.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "grains/close_pairs.hpp"

namespace fpi::grains {
namespace {

void check_inside(const scene::Body& body, std::size_t axis, double lower, double upper, const char* where) {
  const double x = body.position[axis];
  require(!body.is_free() || (x >= lower && x <= upper),
          "the centre of {} must be within {}, {} = {:g} to {:g} m; got {:g} m: move it inside", body.name,
          where, "xyz"[axis], lower, upper, x);
}

void check_places(const scene::Scene& scene) {
  for (const scene::Body& body : scene.bodies)
    for (std::size_t axis = 0; axis < body.position.size(); ++axis) {
      const std::vector<double>& planes = scene.periodic.along(static_cast<int>(axis));
      if (!planes.empty()) check_inside(body, axis, planes[0], planes[1], "the periodic cell");
      if (axis < 2 && scene.fluid && scene.fluid->mesh.file.empty())
        check_inside(body, axis, scene.fluid->mesh.lower[axis], scene.fluid->mesh.upper[axis], "the mesh");
    }
}

void check_overlaps(const scene::Scene& scene) {
  const double allowed = scene.dem.value_or(scene::Dem{}).start_overlap;
  Periods periods{};
  for (const std::size_t axis : {0, 1, 2}) {
    const std::vector<double>& planes = scene.periodic.along(static_cast<int>(axis));
    if (!planes.empty()) periods[axis] = planes[1] - planes[0];
  }
  std::vector<Sphere> spheres;
  for (const scene::Body& body : scene.bodies) spheres.push_back(sphere_around(body));
  for (const auto& [a, b] : close_pairs(spheres, 0, periods)) {
    const scene::Body &one = scene.bodies[a], &other = scene.bodies[b];
    if (!(one.is_free() || other.is_free()) || one.shape == "polygon" || other.shape == "polygon") continue;
    const double distance = length(difference(spheres[a].centre, spheres[b].centre, periods));
    const double overlap = one.radius + other.radius - distance;
    require(
        overlap <= allowed * std::min(one.radius, other.radius),
        "bodies must not overlap at the start by more than {:g} of the smaller radius (dem.start_overlap); "
        "{} and {} do, by {:.3g} m: move one of them, or make them smaller",
        allowed, one.name, other.name, overlap);
  }
}

}  // namespace

Sphere sphere_around(const scene::Body& body) {
  Sphere sphere{.centre = scene::to_vec3(body.position), .radius = body.radius};
  for (std::size_t i = 0; i + 1 < body.vertices.size(); i += 2)
    sphere.radius = std::max(sphere.radius, std::hypot(body.vertices[i], body.vertices[i + 1]));
  return sphere;
}

void check_start(const scene::Scene& scene) {
  check_places(scene);
  check_overlaps(scene);
}

}  // namespace fpi::grains
