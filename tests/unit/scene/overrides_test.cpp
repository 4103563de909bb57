/// Overrides "key=value" given beside the file.
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace fpi::scene {
namespace {

TEST(Overrides, replace_values_in_tables_and_lists) {
  const Scene s = read_text(settling, "drop.toml",
                            {"fluid.density=2", "bodies.0.radius=0.1", "gravity.1=-1", "title=two words"});
  EXPECT_EQ(s.fluid->density, 2);
  EXPECT_EQ(s.bodies[0].radius, 0.1);
  EXPECT_EQ(s.gravity[1], -1);
  EXPECT_EQ(s.title, "two words");
}

TEST(Overrides, make_the_tables_that_they_need) {
  EXPECT_EQ(read_text(settling, "drop.toml", {"coupling.relaxation=0.25"}).coupling.relaxation, 0.25);
}

TEST(Overrides, take_words_without_quotes_and_values_with_an_equals_sign) {
  EXPECT_EQ(read_text(settling, "drop.toml", {"coupling.acceleration=constant"}).coupling.acceleration,
            "constant");
  EXPECT_EQ(read_text(settling, "drop.toml", {"title=\"a=b\""}).title, "a=b");
}

TEST(Overrides, are_named_in_errors) {
  EXPECT_EQ(
      error_of(settling, {"fluid.density=-2"}),
      "--set fluid.density=-2: fluid.density must be a finite number > 0 kg/m³; got -2: correct it (fluid "
      "density ρ)");
  EXPECT_EQ(error_of(settling, {"fluid.densty=2"}),
            "--set fluid.densty=2: the key \"fluid.densty\" is not known; did you mean \"density\"?");
  EXPECT_EQ(error_of(settling, {"couplign.relaxation=1"}),
            "--set couplign.relaxation=1: the key \"couplign\" is not known; did you mean \"coupling\"?");
}

TEST(Overrides, that_cannot_be_applied_say_why) {
  EXPECT_EQ(error_of(settling, {"fluid.density"}),
            "--set fluid.density: an override must be written key=value; got \"fluid.density\"");
  EXPECT_EQ(error_of(settling, {"bodies.7.radius=1"}),
            "--set bodies.7.radius=1: the index must be a number below 1 (entries count from 0); got \"7\"");
  EXPECT_EQ(
      error_of(settling, {"title.colour=1"}),
      "--set title.colour=1: \"colour\" must belong to a table or a list; got \"a disc settles\" there");
}

}  // namespace
}  // namespace fpi::scene
