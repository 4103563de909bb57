/// A plane scene is a metre of depth times its thickness: nothing that moves in it depends on that.
#include <gtest/gtest.h>

#include "grains.hpp"

namespace fpi::dem {
namespace {

using test::body;
using test::material;
using test::step;

/// Discs that fall into each other and on a floor, with friction, adhesion and attraction.
Problem falling(double thickness, const std::string& contact) {
  Problem problem = test::on_floor(material(1e7, 0.25, 0.5, 0.3), body("a", "disc", 0.01, 2500, {0, 0.02}));
  problem.bodies.push_back(body("b", "disc", 0.012, 2500, {0.005, 0.05}));
  problem.materials[0].normal_stiffness = 1e6;
  problem.materials[0].adhesion = 1;
  problem.dem.contact = contact;
  problem.dem.near_field = {.attraction = 0.1, .cut_off = 0.05};
  problem.dem.lubrication.viscosity = 0.1;
  problem.thickness = thickness;
  return problem;
}

TEST(Thickness, changes_nothing_of_the_motion) {
  for (const std::string contact : {"hertz", "linear"}) {
    Solver thick(falling(1, contact)), thin(falling(0.01, contact));
    for (int k = 0; k < 100; ++k) {
      const Advanced one = step(thick, 2e-3), other = step(thin, 2e-3);
      ASSERT_NEAR(one.largest_overlap, other.largest_overlap, 1e-6);
    }
    for (const int i : {0, 1}) {
      EXPECT_NEAR((thick.motions().position[i] - thin.motions().position[i]).norm(), 0, 1e-6) << contact;
      EXPECT_NEAR(thick.motions().spin[i].z(), thin.motions().spin[i].z(), 1e-3) << contact;
    }
    EXPECT_NEAR(thin.model().bodies.mass[0], 0.01 * thick.model().bodies.mass[0], 1e-12);
  }
}

TEST(Thickness, is_none_of_a_scene_in_space) {
  Problem problem = falling(0.01, "hertz");
  for (scene::Body& sphere : problem.bodies) sphere.shape = "sphere";
  const Model model = make_model(problem);
  problem.thickness = 1;
  EXPECT_EQ(model.laws(0, 0).normal, make_model(problem).laws(0, 0).normal);
  EXPECT_EQ(model.near_field.attraction, 0.1);
}

}  // namespace
}  // namespace fpi::dem
