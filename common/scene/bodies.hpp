/// The bodies of a scene: discs and polygons (plane scenes) or spheres, with their motion. All roles read
/// them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/parameters.hpp"
#include "core/polygon.hpp"

namespace fpi::scene {

using Vec3 = std::array<double, 3>;  ///< plane scenes leave z = 0; a plane spin is the z component

inline constexpr std::array<std::string_view, 3> motions{"free", "fixed", "prescribed"};

/// What one of [[bodies]] and a group of [[grains]] say alike: density, motion and material.
template <class Group>
void declare_motion(ParameterVisitor& v, Group& g) {
  const std::size_t axes = g.axes(), spins = g.is_plane() ? 1 : 3;
  g.velocity.resize(axes);  // the defaults, zero, take the length that the shape asks for
  g.spin.resize(spins);
  v.reals({"velocity", "m/s", "velocity of the centre at the start"}, g.velocity, {axes, axes}, any_number());
  v.reals({"spin", "rad/s", "spin at the start: [ω] in the plane, three entries of a sphere"}, g.spin,
          {spins, spins}, any_number());
  v.choice({"motion", "", "free: moved by the DEM; fixed: held; prescribed: moves by formulas of t"},
           g.motion, motions);
  const bool needed = g.motion == "free" && g.shape != "polygon";  // a free polygon is refused as such
  v.real({"density", "kg/m³", "density; 0 only where it moves freely in a fluid", needed}, g.density,
         not_negative());
  v.formulas({"prescribed_velocity", "m/s", "velocity as formulas of t, for motion = \"prescribed\""},
             g.prescribed_velocity, {0, 3});
  v.formula({"prescribed_spin", "rad/s", "spin about z as a formula of t, for motion = \"prescribed\""},
            g.prescribed_spin);
  v.text({"material", "", "a name of [[materials]]; empty takes the first"}, g.material);
  v.require(g.motion != "prescribed" || g.prescribed_velocity.size() == axes, "prescribed_velocity",
            "must have a formula for each axis where motion = \"prescribed\"");
  v.require(g.motion == "prescribed" || (g.prescribed_velocity.empty() && g.prescribed_spin == "0"),
            g.prescribed_velocity.empty() ? "prescribed_spin" : "prescribed_velocity",
            "goes with motion = \"prescribed\" only: remove it or change the motion");
}

/// Whether formulas carry it along.
template <class Group>
bool travels(const Group& g) {
  return std::ranges::any_of(g.prescribed_velocity, [](const std::string& v) { return v != "0"; });
}

/// [[bodies]]
struct Body {
  std::string name;
  std::string shape = "disc";          ///< disc | polygon | sphere
  double radius = 0;                   ///< contact radius R [m]; 0 of a polygon
  std::vector<double> vertices;        ///< of a polygon: x, y of each, from `position` [m]
  double density = 0;                  ///< ρ_s [kg/m³]
  std::vector<double> position;        ///< centre at the start [m], 2 or 3 entries
  std::vector<double> velocity{0, 0};  ///< at the start [m/s]
  std::vector<double> spin{0};         ///< ω at the start [rad/s]: one entry in the plane, three in space
  std::string motion = "free";         ///< free | fixed | prescribed
  std::vector<std::string> prescribed_velocity;  ///< [m/s], formulas of t, for motion = "prescribed"
  std::string prescribed_spin = "0";             ///< [rad/s], formula of t
  bool rotates = true;                           ///< false: forces do not turn it
  std::string material;  ///< a name of [[materials]]; "" takes the first, or none where nothing touches

  static constexpr std::array<std::string_view, 3> shapes{"disc", "polygon", "sphere"};

  void declare(ParameterVisitor& v) {
    v.text({"name", "", "name in reports and results; unique", true}, name);
    v.choice({"shape", "", "disc or polygon in a plane scene, sphere in space"}, shape, shapes);
    const bool polygon = shape == "polygon";
    v.real({"radius", "m", "contact radius R of a disc or sphere", !polygon}, radius,
           polygon ? not_negative() : positive());
    v.require(!polygon || radius == 0, "radius", "goes with discs and spheres only: remove it");
    v.reals({"vertices", "m",
             "of a polygon: x, y of its corners one after another, seen from its position; either turn"},
            vertices, {0, 10000}, any_number());
    const std::string problem = polygon            ? polygon_problem(vertices)
                                : vertices.empty() ? ""
                                                   : "goes with shape = \"polygon\" only: remove it";
    v.require(problem.empty(), "vertices", problem);
    v.reals({"position", "m", "centre at the start: [x, y] in the plane, [x, y, z] of a sphere", true},
            position, {axes(), axes()}, any_number());
    declare_motion(v, *this);
    v.boolean({"rotates", "", "false: a free body that moments do not turn, like a block"}, rotates);
    v.require(!polygon || motion != "free", "motion",
              "must be \"fixed\" or \"prescribed\" for a polygon: there is no contact law for polygons yet");
  }

  bool is_free() const { return motion == "free"; }
  /// False for a body that is held, and for a disc that spins about its own centre.
  bool changes_place() const {
    return is_free() || travels(*this) || (shape == "polygon" && prescribed_spin != "0");
  }
  bool is_plane() const { return shape != "sphere"; }
  std::size_t axes() const { return is_plane() ? 2 : 3; }
  /// Volume [m³] of the body seen with radius r; a disc or polygon is a cylinder of the scene's thickness.
  double volume(double r, double thickness) const {
    if (shape == "polygon") return std::abs(signed_area(vertices)) * thickness;
    return shape == "disc" ? std::numbers::pi * r * r * thickness : 4.0 / 3.0 * std::numbers::pi * r * r * r;
  }
  /// The vertices counter-clockwise.
  std::vector<double> surface() const { return counter_clockwise(vertices); }
};

/// First three components of a list of up to three, the rest zero.
inline Vec3 to_vec3(const std::vector<double>& v) {
  Vec3 out{};
  for (std::size_t i = 0; i < v.size() && i < 3; ++i) out[i] = v[i];
  return out;
}
/// A spin written [ω] turns about z.
inline Vec3 spin_to_vec3(const std::vector<double>& v) {
  return v.size() == 1 ? Vec3{0, 0, v[0]} : to_vec3(v);
}

}  // namespace fpi::scene
