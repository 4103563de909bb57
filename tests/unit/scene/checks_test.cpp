/// Conditions between the keys of a scene, and their wording.
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace fpi::scene {
namespace {

struct Case {
  const char* name;
  std::string text, message;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class Checks : public testing::TestWithParam<Case> {};

TEST_P(
    Checks,
    says_what_does_not_hold) {  // A line of what is told: other problems of the same change stand beside it.
  const std::string told = "\n" + error_of(GetParam().text) + "\n";
  EXPECT_NE(told.find("\n" + std::string(GetParam().message) + "\n"), std::string::npos) << told;
}

const std::string second_body = "[[bodies]]\nname = \"disc\"\nradius = 1\ndensity = 1\nposition = [1, 1]\n";

INSTANTIATE_TEST_SUITE_P(
    Scene, Checks,
    testing::Values(
        Case{"unique_names", settling + second_body,
             "drop.toml:39: bodies.1.name must be unique among [[bodies]]; got \"disc\""},
        Case{"plain_names", with(settling, "name = \"disc\"", "name = \"a,b\""),
             "drop.toml:25: bodies.0.name must be a word of letters a-z, digits, _ and -; got \"a,b\""},
        Case{"known_material", with(settling, "radius =", "material = \"stel\"\nradius ="),
             "drop.toml:26: bodies.0.material must name one of [[materials]] (did you mean \"steel\"?); got "
             "\"stel\""},
        Case{"known_wall_material", settling + "material = \"glass\"\n",
             "drop.toml:38: walls.0.material must name one of [[materials]] (steel); got \"glass\""},
        Case{"plane_fluid",
             with(with(settling, "[0.01, 0.04]", "[0.01, 0.04, 0]"),
                  "radius =", "shape = \"sphere\"\nradius ="),
             "drop.toml:26: bodies.0.shape must be \"disc\" or \"polygon\" where there is a [fluid], which "
             "is plane; "
             "got \"sphere\""},
        Case{"plane_gravity", with(settling, "[0, -9.81]", "[0, -9.81, 0]"),
             "drop.toml:2: gravity must have 2 entries, as the bodies are discs; got [0, -9.81, 0]"},
        Case{"plane_wall", with(settling, "normal = [0, 1]", "normal = [0, 1, 0]"),
             "drop.toml:37: walls.0.normal must have 2 entries, as the bodies are discs; got [0, 1, 0]"},
        Case{"wall_normal", with(settling, "normal = [0, 1]", "normal = [0, 0]"),
             "drop.toml:37: walls.0.normal must not be zero; got [0, 0]"},
        Case{"plane_wall_shape", with(settling, "point = [0, 0]\n", "shape = \"mesh\"\nfile = \"a.stl\"\n"),
             "drop.toml:38: walls.0.normal goes with shape = \"plane\" only: remove it; got [0, 1]"},
        Case{"mesh_in_space",
             with(with(settling, "normal = [0, 1]\n", ""), "point = [0, 0]",
                  "shape = \"mesh\"\nfile = \"a.stl\""),
             "drop.toml:36: walls.0.shape must be \"plane\", \"polyline\" or \"arc\" in a plane scene; got "
             "\"mesh\""},
        Case{"polyline_vertices",
             with(with(settling, "normal = [0, 1]\n", ""), "point = [0, 0]",
                  "shape = \"polyline\"\nvertices = [0, 1, 2]"),
             "drop.toml:37: walls.0.vertices must be x, y of two vertices or more; got [0, 1, 2]"},
        Case{"arc_angles",
             with(with(settling, "normal = [0, 1]\n", ""), "point = [0, 0]",
                  "shape = \"arc\"\ncentre = [0, 0]\nradius = 1\nstart = 3\nend = 2"),
             "drop.toml:40: walls.0.end must be beyond start by at most a whole turn, 2π; got 2"},
        Case{"wall_spin", settling + "spin = 3\n",
             "drop.toml:38: walls.0.spin must be a list [...] of 1 to 3 formulas rad/s; got 3: correct it "
             "(about the centre, formulas of t: [ω] about z, or three)"},
        Case{"wall_centre", settling + "spin = [3]\n",
             "drop.toml:34: walls.0.centre must be given for a wall with a spin; got nothing"},
        Case{"every_side", with(settling, "top.type = \"no_slip\"\n", ""),
             "drop.toml:18: fluid.boundaries.top must have a condition: add a table with its type; got "
             "nothing"},
        Case{"known_side", with(settling, "top.type", "topp.type"),
             "drop.toml:22: fluid.boundaries.topp is not a side of the rectangle (did you mean \"top\"?); "
             "got a "
             "table"},
        Case{"coefficients_on", settling + "[coefficients]\non = \"disk\"\nvelocity = 1\nlength = 1\n",
             "drop.toml:39: coefficients.0.on must name a body or a boundary that holds the fluid (did you "
             "mean \"disc\"?); got "
             "\"disk\""},
        Case{"free_body_density", with(settling, "density = 1250\n", ""),
             "drop.toml:24: bodies.0.density is required, a finite number ≥ 0 kg/m³; got nothing: add "
             "density = … "
             "(density; 0 only where it moves freely in a fluid)"},
        Case{"dry_body_without_mass",
             "[[bodies]]\nname = \"a\"\nradius = 1\nposition = [0, 0]\ndensity = 0\n[time]\nstep = 1\nend = "
             "1\n",
             "drop.toml:5: bodies.0.density must be > 0 kg/m³ of a free body where there is no fluid to "
             "move; got 0"},
        Case{
            "stiffness_is_not_negative", with(settling, "youngs_modulus = 1e6", "youngs_modulus = -5"),
            "drop.toml:32: materials.0.youngs_modulus must be a finite number ≥ 0 Pa; got -5: correct it (E, "
            "needed where dem.contact = \"hertz\"; discs touch as spheres of their radius, whatever the "
            "thickness)"},
        Case{"linear_stiffness_is_given", settling + "[dem]\ncontact = \"linear\"\n",
             "drop.toml:30: materials.0.normal_stiffness must be > 0 N/m where dem.contact = \"linear\"; got "
             "nothing"},
        Case{"contact_needs_material",
             with(settling, "[[materials]]\nname = \"steel\"\nyoungs_modulus = 1e6\n", ""),
             "drop.toml:1: materials must have an entry where free bodies can touch walls or each other; got "
             "nothing"},
        Case{"steady_free_body", with(settling, "[time]\n", "[time]\nsteady = true\n"),
             "drop.toml:5: time.steady must be false where bodies move freely; got true"},
        Case{"nothing_to_do", "[time]\nstep = 1\nend = 1\n",
             "drop.toml:1: fluid must be there where no body is free: nothing would happen; got nothing"},
        Case{"error_in_time_of_a_fluid",
             "[time]\nstep = 1\nend = 1\nrelative_tolerance = 1e-3\n" + second_body,
             "drop.toml:4: time.relative_tolerance must go with a [fluid], which estimates the error; got "
             "0.001"},
        Case{"way_in_elements_of_a_fluid",
             "[time]\nstep = 1\nend = 1\nmax_displacement = 0.4\n" + second_body,
             "drop.toml:4: time.max_displacement must go with a [fluid], whose elements it counts in; got "
             "0.4"},
        Case{
            "hydraulic_radius", "hydraulic_radius_ratio = 1.5\n" + settling,
            "drop.toml:1: hydraulic_radius_ratio must be a finite number in (0, 1]; got 1.5: correct it "
            "(radius "
            "that the fluid sees over the contact radius; below 1 touching discs let fluid through; polygons "
            "keep their size)"},
        Case{"one_viscosity", with(settling, "density = 1000", "density = 1000\ndynamic_viscosity = 1"),
             "drop.toml:10: fluid.dynamic_viscosity must be given, or kinematic_viscosity, and not both; got "
             "1"},
        Case{"time_step", with(settling, "step = 0.001\n", ""),
             "drop.toml:4: time.step must be > 0 s (or steady = true); got nothing"},
        Case{
            "mesh_or_rectangle", with(settling, "lower = [0, 0]\n", ""),
            "drop.toml:12: fluid.mesh.lower must name a mesh, or else lower = [x, y] and upper = [x, y] must "
            "give the corners of a rectangle; got nothing"},
        Case{"box_of_free_bodies",
             with(settling, "cells_y = 12\n", "cells_y = 12\nfree_bodies_box = [0, 0, 1, 1]\n"),
             "drop.toml:17: fluid.mesh.free_bodies_box must be [x0, y0, x1, y1] with x0 < x1 and y0 < y1, "
             "beside "
             "elements_per_diameter; got [0, 0, 1, 1]"},
        Case{"elements_per_diameter_of_a_rectangle",
             with(settling, "lower = [0, 0]\nupper = [0.02, 0.06]\ncells_x = 4\ncells_y = 12\n",
                  "file = \"box.msh\"\nelements_per_diameter = 8\n"),
             "drop.toml:13: fluid.mesh.file has its own triangles: remove elements_per_diameter; got "
             "\"box.msh\""},
        Case{"refinement_region",
             with(settling, "cells_y = 12\n", "cells_y = 12\n[[fluid.mesh.refinements]]\nsize = 1e-3\n"),
             "drop.toml:18: fluid.mesh.refinements.0.size must come with one region: box = [x0, y0, x1, y1], "
             "centre = [x, y] and radius, or line = [x0, y0, x1, y1, …]; got 0.001"},
        Case{"refinement_box",
             with(settling, "cells_y = 12\n",
                  "cells_y = 12\n[[fluid.mesh.refinements]]\nsize = 1e-3\nbox = [0, 1, 1, 0]\n"),
             "drop.toml:19: fluid.mesh.refinements.0.box must be [x0, y0, x1, y1] with x0 <= x1 and y0 <= "
             "y1; got "
             "[0, 1, 1, 0]"},
        Case{"circle_of_a_rectangle",
             with(settling, "cells_y = 12\n",
                  "cells_y = 12\n[[fluid.mesh.circles]]\nboundary = \"top\"\ncentre = [0, 0]\nradius = 1\n"),
             "drop.toml:13: fluid.mesh.lower must not be given with circles, which are for a mesh file; got "
             "[0, 0]"},
        Case{"velocity_of_its_type",
             with(settling, "top.type = \"no_slip\"", "top = {type = \"no_slip\", velocity = [1, 0]}"),
             "drop.toml:22: fluid.boundaries.top.velocity goes with type = \"velocity\" only; got [1, 0]"},
        Case{"prescribed_velocity", with(settling, "radius =", "motion = \"prescribed\"\nradius ="),
             "drop.toml:24: bodies.0.prescribed_velocity must have a formula for each axis where motion = "
             "\"prescribed\"; got nothing"},
        Case{"coefficients_names",
             settling + "[[coefficients]]\non = \"disc\"\nvelocity = 1\nlength = 1\n"
                        "[[coefficients]]\nname = \"wall\"\non = \"top\"\nvelocity = 1\nlength = 1\n",
             "drop.toml:38: coefficients.0.name must be a word of letters a-z, digits, _ and -; got nothing"},
        Case{"boundary_of_a_body", with(settling, "name = \"disc\"", "name = \"top\""),
             "drop.toml:22: fluid.boundaries.top must not have the name of a body: both are columns of "
             "history.csv; got a table"},
        Case{"measure_from", settling + "[output]\nmeasure_from = 1e6\n",
             "drop.toml:39: output.measure_from must be before the end of the run (time.end); got 1000000.0"},
        Case{"profile_of_a_point",
             settling + "[[profiles]]\nname = \"p\"\nquantity = \"speed\"\nfrom = [0, 1]\nto = [0, 1]\n",
             "drop.toml:42: profiles.0.to must be another point than from; got [0, 1]"},
        Case{"probe_name", settling + "[[probes]]\nname = \"drag\"\npoint = [0, 0]\n",
             "drop.toml:39: probes.0.name must not be the name of another column of history.csv; got "
             "\"drag\""},
        Case{"dry_probe",
             with(with(settling,
                       settling.substr(settling.find("[fluid]"),
                                       settling.find("[[bodies]]") - settling.find("[fluid]")),
                       ""),
                  "[time]", "[[probes]]\nname = \"p\"\npoint = [0, 0]\n\n[time]"),
             "drop.toml:4: probes must go with a [fluid]; got [a table]"}),
    [](const auto& one) { return std::string(one.param.name); });

/// The settling disc between walls left and right alone.
std::string periodic_along_y() {
  const std::string walls = "left.type = \"no_slip\"\nright.type = \"no_slip\"\n";
  const std::string all = walls + "bottom.type = \"no_slip\"\ntop.type = \"no_slip\"\n";
  return with(with(settling, all, walls), "[fluid]\n",
              "[periodic]\ny = [0, 0.06]\n\n[fluid]\npressure_drop = [0, 2]\n");
}

TEST(PeriodicScene, sides_of_a_rectangle_are_boundaries_or_periodic) {
  EXPECT_EQ(error_of(periodic_along_y()), "");
  EXPECT_NE(error_of(with(periodic_along_y(), "0.06]\n\n", "0.05]\n\n"))
                .find("must be the sides of the rectangle, [0, 0.06]"),
            std::string::npos);
  EXPECT_NE(error_of(with(periodic_along_y(), "left.type", "top.type = \"slip\"\nleft.type"))
                .find("is no boundary where the scene is periodic along y"),
            std::string::npos);
  EXPECT_NE(
      error_of(with(periodic_along_y(), "[0, 2]", "[1, 2]")).find("must be 0 along x, which is not periodic"),
      std::string::npos);
  EXPECT_NE(
      error_of(with(periodic_along_y(), "[0, 0.06]", "[0.06, 0]")).find("must be [lower, upper], ascending"),
      std::string::npos);
}

TEST(PeriodicScene, the_grains_know_the_periodic_box) {
  const Scene scene = read_text(periodic_along_y(), "drop.toml");
  for (const Part part : {Part::fluid, Part::dem})
    EXPECT_EQ(read_text(write_text(part_of(part, scene)), "part").periodic.y, (std::vector{0, 0.06}));
}

TEST(PeriodicScene, a_superficial_velocity_goes_along_periodic_axes_and_instead_of_a_pressure_drop) {
  const std::string drop = "pressure_drop = [0, 2]", velocity = "superficial_velocity = [0, 0.1]";
  EXPECT_EQ(error_of(with(periodic_along_y(), drop, velocity)), "");
  EXPECT_NE(error_of(with(periodic_along_y(), drop, drop + "\n" + velocity)).find("it is found"),
            std::string::npos);
  EXPECT_NE(error_of(with(periodic_along_y(), drop, "superficial_velocity = [0.1, 0]"))
                .find("must be 0 along x, which is not periodic"),
            std::string::npos);
}

}  // namespace
}  // namespace fpi::scene
