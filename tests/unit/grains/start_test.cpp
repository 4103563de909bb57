#include "grains/start.hpp"

#include <gtest/gtest.h>

#include "spheres.hpp"

namespace fpi::grains {
namespace {

std::string disc(const std::string& name, const std::string& position, const std::string& more = "") {
  return "[[bodies]]\nname = \"" + name + "\"\nradius = 0.1\ndensity = 1\nposition = " + position + "\n" +
         more;
}

TEST(Start, bodies_that_overlap_are_named) {
  EXPECT_EQ(
      error_of(disc("a", "[0, 0]") + disc("b", "[0.15, 0]")),
      "bodies must not overlap at the start by more than 0.01 of the smaller radius (dem.start_overlap); a "
      "and b do, by 0.05 m: move one of them, or make them smaller");
  const std::string more = "[dem]\nstart_overlap = 0.5\n";
  EXPECT_EQ(error_of(more + disc("a", "[0, 0]") + disc("b", "[0.151, 0]")), "") << "the scene may allow more";
  EXPECT_EQ(error_of(disc("a", "[0, 0]") + disc("b", "[0.1995, 0]")), "") << "a hundredth is let pass";
  const std::string free = disc("c", "[9, 9]"), held = "motion = \"fixed\"\n";
  EXPECT_EQ(error_of(free + disc("a", "[0, 0]", held) + disc("b", "[0.15, 0]", held)), "") << "both are held";
}

TEST(Start, bodies_of_groups_are_named_too) {
  const std::string group =
      "[[grains]]\nname = \"sand\"\ngenerator = \"square\"\nlower = [0, 0]\nupper = [1, 1]\nradius = "
      "0.1\ndensity = 1\n";
  EXPECT_NE(error_of(disc("a", "[0.32, 0.1]") + group).find("a and sand.1 do"), std::string::npos)
      << error_of(disc("a", "[0.32, 0.1]") + group);
}

TEST(Start, free_bodies_are_inside_the_periodic_cell) {
  const std::string cell = "[periodic]\nx = [0, 1]\n";
  EXPECT_EQ(error_of(cell + disc("a", "[1.5, 0]")),
            "the centre of a must be within the periodic cell, x = 0 to 1 m; got 1.5 m: move it inside");
  EXPECT_NE(error_of(cell + disc("a", "[0.05, 0]") + disc("b", "[0.95, 0]")), "")
      << "they overlap through the sides";
}

TEST(Start, free_bodies_are_inside_the_mesh) {
  const std::string fluid =
      "[fluid]\ndensity = 1\ndynamic_viscosity = 1\n[fluid.mesh]\nlower = [0, 0]\nupper = [1, 1]\ncells_x = "
      "2\n"
      "cells_y = 2\n[fluid.boundaries]\nleft.type = \"no_slip\"\nright.type = \"no_slip\"\nbottom.type = "
      "\"no_slip\"\ntop.type = \"no_slip\"\n";
  EXPECT_EQ(error_of(fluid + disc("a", "[0.5, -0.2]")),
            "the centre of a must be within the mesh, y = 0 to 1 m; got -0.2 m: move it inside");
  EXPECT_EQ(error_of(fluid + disc("a", "[0.5, 0.2]")), "");
}

}  // namespace
}  // namespace fpi::grains
