#include "grains/static_overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fpi::grains {
namespace {

/// A disc of 2 cm that falls on a floor.
std::string falling(const std::string& modulus, const std::string& more = "") {
  return more +
         "gravity = [0, -9.81]\n[time]\nstep = 1e-3\nend = 1\n"
         "[[bodies]]\nname = \"disc\"\nradius = 0.01\ndensity = 2500\nposition = [0, 0.05]\n"
         "[[materials]]\nname = \"m\"\nyoungs_modulus = " +
         modulus + "\n[[walls]]\nname = \"floor\"\npoint = [0, 0]\nnormal = [0, 1]\n";
}

scene::Scene read(const std::string& text) { return scene::read_text(text, "test"); }

TEST(StaticOverlap, is_where_the_contact_of_a_sphere_carries_the_weight_of_the_thickness) {
  const double weight = 9.81 * 2500 * std::numbers::pi * 1e-4;
  const double modulus = 1e6 / (2 * (1 - 0.0625));
  const double expected = std::pow(weight / (4.0 / 3 * modulus * 0.1), 2.0 / 3) / 0.01;
  const auto found = [](const std::string& more) {
    return deepest_static_overlap(read(falling("1e6", more)));
  };
  EXPECT_NEAR(found("").share, expected, 1e-12);
  EXPECT_NEAR(found("thickness = 0.01\n").share, expected * std::pow(0.01, 2.0 / 3), 1e-12);
  EXPECT_EQ(found("").on, "wall floor");
  EXPECT_NEAR(expected, 0.23, 0.005);
}

TEST(StaticOverlap, is_told_of_a_material_that_is_too_soft) {
  const auto told = soft_materials(read(falling("1e6")));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("disc sinks by 0.23 of its radius into wall floor under its own weight"), 0u)
      << told[0];
  EXPECT_TRUE(soft_materials(read(falling("1e8"))).empty());
}

TEST(StaticOverlap, goes_with_the_linear_stiffness_and_the_buoyancy) {
  const std::string linear = "dem = {contact = \"linear\"}\n";
  std::string text = falling("1", linear);
  text.replace(text.find("youngs_modulus = 1"), 18, "normal_stiffness = 1e4");
  const double weight = 9.81 * 2500 * std::numbers::pi * 1e-4;
  EXPECT_NEAR(deepest_static_overlap(read(text)).share, weight / 1e4 / 0.01, 1e-12);
  scene::Scene wet = read(text);
  wet.fluid.emplace();
  wet.fluid->density = 2500;
  EXPECT_NEAR(deepest_static_overlap(wet).share, 0, 1e-12);
}

}  // namespace
}  // namespace fpi::grains
