/// [[walls]]: what stops the grains. Planes in any scene; polylines and arcs in plane ones, meshes in space.
#pragma once

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "core/parameters.hpp"

namespace fpi::scene {

struct Wall {
  std::string name;
  std::string shape = "plane";
  std::vector<double> point, normal;  ///< of a plane
  std::vector<double> vertices;       ///< of a polyline: x, y of each [m]
  bool closed = false;
  std::vector<double> centre;  ///< of an arc, and of any turn [m]
  double radius = 0;           ///< of an arc [m]
  double start = 0, end = 2 * std::numbers::pi;
  std::string file;  ///< of a mesh
  double scale = 1;
  std::vector<std::string> velocity;   ///< [m/s], formulas of t
  std::vector<std::string> spin{"0"};  ///< [rad/s], formulas of t
  std::string material;

  static constexpr std::array<std::string_view, 4> shapes{"plane", "polyline", "arc", "mesh"};

  void declare(ParameterVisitor& v) {
    const auto of = [&](std::string_view s) { return shape == s; };
    v.text({"name", "", "name in reports; unique", true}, name);
    v.choice({"shape", "",
              "plane, with grains on the side of its normal; in a plane scene also polyline or arc, in space "
              "mesh, with grains on either side; in a periodic box it must fit, and is there in every box"},
             shape, shapes);
    v.reals({"point", "m", "a point of the plane", of("plane")}, point, {0, 3}, any_number());
    v.reals({"normal", "", "of the plane, towards the grains; need not be a unit vector", of("plane")},
            normal, {0, 3}, any_number());
    v.reals({"vertices", "m", "of a polyline: x, y of each one after another; two make a segment",
             of("polyline")},
            vertices, {0, 100000}, any_number());
    v.boolean({"closed", "", "true: the polyline goes back to its first vertex"}, closed);
    v.reals({"centre", "m", "of an arc; and the point that a wall with a spin turns about", of("arc")},
            centre, {0, 3}, any_number());
    v.real({"radius", "m", "of an arc", of("arc")}, radius, of("arc") ? positive() : not_negative());
    v.real({"start", "rad", "angle from the x axis at which an arc begins"}, start, any_number());
    v.real({"end", "rad", "angle at which it ends, counter-clockwise; both left out make a circle"}, end,
           any_number());
    v.text({"file", "", "STL file of a mesh, beside the scene", of("mesh")}, file);
    v.real({"scale", "", "length in metres of the mesh file's unit"}, scale, positive());
    v.formulas({"velocity", "m/s", "of the wall's centre, formulas of t; empty: none"}, velocity, {0, 3});
    v.formulas({"spin", "rad/s", "about the centre, formulas of t: [ω] about z, or three"}, spin, {1, 3});
    v.text({"material", "", "a name of [[materials]]; empty takes the first"}, material);
    check(v);
  }

  bool turns() const { return spin != std::vector<std::string>(spin.size(), "0"); }
  bool moves() const { return turns() || velocity != std::vector<std::string>(velocity.size(), "0"); }

 private:
  void check(ParameterVisitor& v) {
    const auto only = [&](bool absent, std::string_view key, std::string_view s, std::string_view text) {
      v.require(absent || shape == s, key, text);
    };
    only(point.empty(), "point", "plane", "goes with shape = \"plane\" only: remove it");
    only(normal.empty(), "normal", "plane", "goes with shape = \"plane\" only: remove it");
    only(vertices.empty(), "vertices", "polyline", "goes with shape = \"polyline\" only: remove it");
    only(radius == 0, "radius", "arc", "goes with shape = \"arc\" only: remove it");
    only(file.empty(), "file", "mesh", "goes with shape = \"mesh\" only: remove it");
    v.require(shape != "mesh" || !file.empty(), "file", "must name an STL file");
    v.require(shape != "polyline" || (vertices.size() >= 4 && vertices.size() % 2 == 0), "vertices",
              "must be x, y of two vertices or more");
    for (std::size_t i = 2; i + 1 < vertices.size(); i += 2)
      v.require(vertices[i] != vertices[i - 2] || vertices[i + 1] != vertices[i - 1], "vertices",
                "must not have the same vertex twice in a row");
    v.require(!closed || vertices.size() < 4 || vertices[0] != vertices[vertices.size() - 2] ||
                  vertices[1] != vertices.back(),
              "vertices", "must not repeat the first one at the end where closed = true");
    v.require(start < end && end - start <= 2 * std::numbers::pi * (1 + 1e-12), "end",
              "must be beyond start by at most a whole turn, 2π");
    v.require(spin.size() != 2, "spin", "must have one entry, about z, or three");
    v.require(!turns() || !centre.empty(), "centre", "must be given for a wall with a spin");
  }
};

}  // namespace fpi::scene
