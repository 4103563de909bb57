#include "coupling/mesh_around_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "coupling/interface_mesh.hpp"
#include "coupling/prescribed_motion.hpp"

namespace fpi::coupling {
namespace {

double length(const scene::Periodic& periodic, int axis) {
  const auto& planes = periodic.along(axis);
  return planes.empty() ? 0 : planes[1] - planes[0];
}

/// Shifts by periods under which [lower, upper] meets the mesh's rectangle; at least none at all.
std::vector<Eigen::Vector2d> images(const scene::Scene& scene, const Eigen::Vector2d& lower,
                                    const Eigen::Vector2d& upper) {
  const scene::Mesh& mesh = scene.fluid->mesh;
  const auto shifts = [&](int axis) {
    std::vector<double> out{0};
    const double period = length(scene.periodic, axis);
    for (const double shift : {-period, period})
      if (period > 0 && lower[axis] + shift < mesh.upper[axis] && upper[axis] + shift > mesh.lower[axis])
        out.push_back(shift);
    return out;
  };
  std::vector<Eigen::Vector2d> out;
  for (const double x : shifts(0))
    for (const double y : shifts(1)) out.emplace_back(x, y);
  return out;
}

/// Where a body is at a time; `extent` is how far its surface is from the centre.
struct Place {
  RigidMotion motion;
  double angle, extent;

  Place(const RigidMotion& m, double reach)
      : motion(m), angle(2 * std::atan2(m.orientation.z(), m.orientation.w())), extent(reach) {}
  /// No point of the surface is farther away than this in the other place [m].
  double distance(const Place& other) const {
    const double turn = std::remainder(angle - other.angle, 2 * std::numbers::pi);
    return (motion.position - other.motion.position).norm() + extent * std::abs(turn);
  }
};

/// Largest distance of a polygon's surface from its position; 0 of a disc, which stays as it is when it
/// turns.
double extent_that_turns(const scene::Body& body) {
  double largest = 0;
  for (std::size_t i = 0; i + 1 < body.vertices.size(); i += 2)
    largest = std::max(largest, std::hypot(body.vertices[i], body.vertices[i + 1]));
  return largest;
}

/// Places of a body over the run such that it is never farther than `spacing` from one of them.
std::vector<Place> path(const scene::Body& body, const scene::Scene& scene, double spacing) {
  constexpr double most_samples = 1e5, samples_per_step = 4;
  const scene::Time& time = scene.time;
  const double extent = extent_that_turns(body);
  RigidMotion motion = initial_motion(body);
  motion.position = scene.periodic.inside(motion.position);
  std::vector<Place> places{{motion, extent}};
  if (time.steady || !body.changes_place()) return places;
  const PrescribedMotion prescribed(body);
  const double samples = std::min(most_samples, std::ceil(samples_per_step * time.end / time.step));
  for (double k = 0; k < samples; ++k) {
    motion = prescribed.advanced(motion, k * time.end / samples, (k + 1) * time.end / samples);
    motion.position = scene.periodic.inside(motion.position);
    const Place place(motion, extent);
    const auto is_near = [&](const Place& other) { return place.distance(other) <= spacing; };
    if (std::ranges::none_of(places, is_near)) places.push_back(place);
  }
  return places;
}

Arcs surface(const scene::Scene& scene, const scene::Body& body, const RigidMotion& motion) {
  constexpr double undivided = std::numeric_limits<double>::infinity();
  return cut_surface(body, motion, scene.hydraulic_radius_ratio, undivided);
}

scene::Refinement around(const Arcs& surface, const Eigen::Vector2d& shift, double size) {
  scene::Refinement refinement;
  refinement.size = size;
  if (surface.radius > 0) {
    refinement.centre = {surface.centre.x() + shift.x(), surface.centre.y() + shift.y()};
    refinement.radius = surface.radius;
    return refinement;
  }
  const std::size_t n = surface.vertices.size();
  for (std::size_t i = 0; i < n + 2; ++i)
    refinement.line.push_back(surface.vertices[i % n] + shift[static_cast<Eigen::Index>(i % 2)]);
  return refinement;
}

/// [x0, y0, x1, y1] of the column through which a free body falls or rises, as its density says, with half a
/// diameter on each side; the whole rectangle where nothing says where it goes.
std::vector<double> column(const scene::Scene& scene, const scene::Body& body, double margin) {
  const scene::Mesh& mesh = scene.fluid->mesh;
  std::vector<double> whole{mesh.lower[0], mesh.lower[1], mesh.upper[0], mesh.upper[1]};
  const double drive = body.density - scene.fluid->density;
  const Eigen::Vector2d down = drive * Eigen::Vector2d(scene.gravity[0], scene.gravity[1]);
  if (down.norm() == 0) return whole;
  const Eigen::Vector2d start = initial_motion(body).position.head<2>();
  const Eigen::Vector2d end =
      start + down.normalized() * std::hypot(whole[2] - whole[0], whole[3] - whole[1]);
  std::vector<double> box = whole;
  for (int axis = 0; axis < 2; ++axis) {
    const bool comes_back = length(scene.periodic, axis) > 0;
    if (comes_back && down[axis] != 0) continue;
    const double least = comes_back ? -1e300 : whole[axis], largest = comes_back ? 1e300 : whole[axis + 2];
    box[axis] = std::clamp(std::min(start[axis], end[axis]) - margin, least, largest);
    box[axis + 2] = std::clamp(std::max(start[axis], end[axis]) + margin, least, largest);
  }
  return box;
}

void refine_for_free(const scene::Scene& scene, const scene::Body& body, double size, MeshAroundBodies& out) {
  const scene::Mesh& mesh = scene.fluid->mesh;
  scene::Refinement region;
  region.size = size;
  region.box = mesh.free_bodies_box.empty() ? column(scene, body, mesh.elements_per_diameter * size)
                                            : mesh.free_bodies_box;
  out.notes.push_back(fmt::format(
      "triangles of {:.3g} m where body \"{}\" is expected, in [{:.4g}, {:.4g}] × [{:.4g}, {:.4g}] m; "
      "fluid.mesh.free_bodies_box names another place",
      size, body.name, region.box[0], region.box[2], region.box[1], region.box[3]));
  const std::vector<double> box = region.box;
  for (const Eigen::Vector2d& shift : images(scene, {box[0], box[1]}, {box[2], box[3]})) {
    for (int k = 0; k < 4; ++k) region.box[k] = box[k] + shift[k % 2];
    out.refinements.push_back(region);
  }
}

void refine_along_path(const scene::Scene& scene, const scene::Body& body, double size,
                       MeshAroundBodies& out) {
  // Triangles that a place within half their size meets are as small as if it met them itself.
  const std::vector<Place> places = path(body, scene, size / 2);
  for (const Place& place : places) {
    const Eigen::Vector2d centre = place.motion.position.head<2>(),
                          reach = Eigen::Vector2d::Constant(body.radius + place.extent);
    for (const Eigen::Vector2d& shift : images(scene, centre - reach, centre + reach))
      out.refinements.push_back(around(surface(scene, body, place.motion), shift, size));
  }
  out.notes.push_back(fmt::format("triangles of {:.3g} m around body \"{}\"{}", size, body.name,
                                  places.size() == 1 ? "" : " wherever it comes"));
}

}  // namespace

double diameter(const scene::Body& body, double hydraulic_radius_ratio) {
  if (body.shape == "polygon") return 2 * std::sqrt(body.volume(0, 1) / std::numbers::pi);
  return 2 * hydraulic_radius_ratio * body.radius;
}

MeshAroundBodies mesh_around_bodies(const scene::Scene& scene) {
  MeshAroundBodies out;
  if (!scene.fluid || scene.fluid->mesh.elements_per_diameter == 0) return out;
  for (const scene::Body& body : scene.bodies) {
    const double size =
        diameter(body, scene.hydraulic_radius_ratio) / scene.fluid->mesh.elements_per_diameter;
    if (body.is_free())
      refine_for_free(scene, body, size, out);
    else
      refine_along_path(scene, body, size, out);
  }
  return out;
}

}  // namespace fpi::coupling
