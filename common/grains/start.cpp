#include "grains/start.hpp"

#include <algorithm>

#include "grains/close_pairs.hpp"

namespace fpi::grains {
namespace {

std::string key_of(std::size_t body, const char* key) { return fmt::format("bodies.{}.{}", body, key); }

void check_inside(const scene::Scene& scene, std::size_t b, std::size_t axis, double lower, double upper,
                  const char* where, Findings& findings) {
  const scene::Body& body = scene.bodies[b];
  const double x = body.position[axis];
  if (body.is_free() && !(x >= lower && x <= upper))
    findings.error(key_of(b, "position"),
                   "the centre of {} must be within {}, {} = {:g} to {:g} m; got {:g} m: move it inside",
                   body.name, where, "xyz"[axis], lower, upper, x);
}

void check_places(const scene::Scene& scene, Findings& findings) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (std::size_t axis = 0; axis < scene.bodies[b].position.size(); ++axis) {
      const std::vector<double>& planes = scene.periodic.along(static_cast<int>(axis));
      if (!planes.empty()) check_inside(scene, b, axis, planes[0], planes[1], "the periodic cell", findings);
      if (axis < 2 && scene.fluid && scene.fluid->mesh.file.empty())
        check_inside(scene, b, axis, scene.fluid->mesh.lower[axis], scene.fluid->mesh.upper[axis], "the mesh",
                     findings);
    }
}

void check_overlaps(const scene::Scene& scene, Findings& findings) {
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
    if (one.shape == "polygon" || other.shape == "polygon") continue;
    const double distance = length(difference(spheres[a].centre, spheres[b].centre, periods));
    const double overlap = one.radius + other.radius - distance;
    if (overlap <= allowed * std::min(one.radius, other.radius)) continue;
    if (one.is_free() || other.is_free())
      findings.error(key_of(std::max(a, b), "position"),
                     "bodies must not overlap at the start by more than {:g} of the smaller radius "
                     "(dem.start_overlap); {} and {} do, by {:.3g} m: move one of them, or make them smaller",
                     allowed, one.name, other.name, overlap);
    else if (scene.fluid)
      findings.warn(key_of(std::max(a, b), "position"),
                    "the bodies {} and {}, which are not free, overlap by {:.3g} m: the surface of each has "
                    "multipliers inside the other too, and only the sum of their forces means something; "
                    "move one of them, or make one polygon of both",
                    one.name, other.name, overlap);
  }
}

}  // namespace

Sphere sphere_around(const scene::Body& body) {
  Sphere sphere{.centre = scene::to_vec3(body.position), .radius = body.radius};
  for (std::size_t i = 0; i + 1 < body.vertices.size(); i += 2)
    sphere.radius = std::max(sphere.radius, std::hypot(body.vertices[i], body.vertices[i + 1]));
  return sphere;
}

Findings start_findings(const scene::Scene& scene) {
  Findings findings;
  check_places(scene, findings);
  check_overlaps(scene, findings);
  return findings;
}

}  // namespace fpi::grains
