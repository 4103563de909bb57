#include "grains/static_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fpi::grains {
namespace {

constexpr double soft = 0.05;  ///< overlap over radius; contact laws mean much less

const scene::Material* material_of(const scene::Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.materials, name, &scene::Material::name);
  if (found != scene.materials.end()) return &*found;
  return scene.materials.empty() ? nullptr : &scene.materials.front();
}

/// Overlap [m] of a contact of the effective radius that carries `weight` [N]: F = 4/3 E* √R* δ^(3/2), or k
/// δ, both for a metre of depth in a plane scene.
double overlap(const scene::Scene& scene, const scene::Material& a, const scene::Material& b, double radius,
               double weight, double depth) {
  const scene::Dem dem = scene.dem.value_or(scene::Dem{});
  if (dem.contact == "linear")
    return weight / depth * dem.stretch * dem.stretch * (0.5 / a.normal_stiffness + 0.5 / b.normal_stiffness);
  const double compliance = (1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
                            (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus;
  const double stiffness = 4.0 / 3 * std::pow(dem.stretch, -2.5) / compliance * std::sqrt(radius) * depth;
  return std::pow(weight / stiffness, 2.0 / 3);
}

double gravity(const scene::Scene& scene) {
  const scene::Vec3 g = scene::to_vec3(scene.gravity);
  return std::hypot(g[0], g[1], g[2]);
}

/// Less the buoyancy [N].
double weight(const scene::Scene& scene, const scene::Body& body) {
  const double seen = scene.hydraulic_radius_ratio * body.radius;
  const double buoyant = scene.fluid ? scene.fluid->density * body.volume(seen, scene.thickness) : 0;
  return gravity(scene) * std::abs(body.density * body.volume(body.radius, scene.thickness) - buoyant);
}

}  // namespace

StaticOverlap deepest_static_overlap(const scene::Scene& scene) {
  StaticOverlap deepest;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    const scene::Material* own = material_of(scene, body.material);
    if (!body.is_free() || !own) continue;
    const double force = weight(scene, body), depth = body.is_plane() ? scene.thickness : 1;
    const auto consider = [&](const scene::Material& other, double radius, const auto& on) {
      const double share = overlap(scene, *own, other, radius, force, depth) / body.radius;
      if (share > deepest.share) deepest = {i, on(), share};
    };
    for (const scene::Wall& wall : scene.walls)
      consider(*material_of(scene, wall.material), body.radius, [&] { return "wall " + wall.name; });
    if (scene.bodies.size() > 1)
      consider(*own, 0.5 * body.radius, [] { return std::string("another body"); });
  }
  return deepest;
}

std::vector<std::string> soft_materials(const scene::Scene& scene) {
  const StaticOverlap found = deepest_static_overlap(scene);
  if (found.share <= soft) return {};
  const bool linear = scene.dem && scene.dem->contact == "linear";
  const std::string depth =
      scene.bodies[found.body].is_plane() ? ", which in a plane scene stands for a metre of depth" : "";
  return {
      fmt::format("{} sinks by {:.2g} of its radius into {} under its own weight: it would be pressed in, or "
                  "pass through. Take a "
                  "larger {}{}; a hundredth is usual",
                  scene.bodies[found.body].name, found.share, found.on,
                  linear ? "normal_stiffness" : "youngs_modulus", depth)};
}

}  // namespace fpi::grains
