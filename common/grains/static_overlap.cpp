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
/// δ.
double overlap(const scene::Dem& dem, const scene::Material& a, const scene::Material& b, double radius,
               double weight) {
  if (dem.contact == "linear")
    return weight * dem.stretch * dem.stretch * (0.5 / a.normal_stiffness + 0.5 / b.normal_stiffness);
  const double compliance = (1 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus +
                            (1 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus;
  const double stiffness = 4.0 / 3 * std::pow(dem.stretch, -2.5) / compliance * std::sqrt(radius);
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
  const scene::Dem dem = scene.dem.value_or(scene::Dem{});
  StaticOverlap deepest;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    const scene::Material* own = material_of(scene, body.material);
    if (!body.is_free() || !own) continue;
    const double force = weight(scene, body);
    const auto consider = [&](const scene::Material& other, double radius, const auto& on) {
      const double share = overlap(dem, *own, other, radius, force) / body.radius;
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
  const scene::Body& body = scene.bodies[found.body];
  const std::string thickness =
      body.is_plane() ? fmt::format(
                            ", or a thickness below {:g} m: discs touch as spheres of their radius, whatever "
                            "their thickness and weight",
                            scene.thickness)
                      : "";
  return {fmt::format(
      "{} sinks by {:.2g} of its radius into {} under its own weight, and may be pressed through: a "
      "hundredth is usual. "
      "Take a larger {}{}",
      body.name, found.share, found.on, linear ? "normal_stiffness" : "youngs_modulus", thickness)};
}

}  // namespace fpi::grains
