/// Polygons in a scene: what they enclose, and what is refused.
#include <gtest/gtest.h>

#include "core/polygon.hpp"
#include "scenes.hpp"

namespace fpi::scene {
namespace {

const std::string polygon = with(with(settling, "radius = 0.00125\ndensity = 1250",
                                      "shape = \"polygon\"\nvertices = [0, 0, 1e-3, 0, 0, 1e-3]"),
                                 "position = [0.01, 0.04]", "position = [0.01, 0.04]\nmotion = \"fixed\"");

TEST(Polygon, area_is_that_of_the_shoelace_formula_with_the_sign_of_the_turn) {
  EXPECT_DOUBLE_EQ(signed_area({0, 0, 2, 0, 2, 1, 1, 1, 1, 3, 0, 3}), 4);
  EXPECT_DOUBLE_EQ(signed_area({0, 3, 1, 3, 1, 1, 2, 1, 2, 0, 0, 0}), -4);
}

TEST(Polygon, is_turned_counter_clockwise) {
  EXPECT_EQ(counter_clockwise({0, 0, 0, 1, 1, 0}), (std::vector<double>{1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(counter_clockwise({0, 0, 1, 0, 0, 1}), (std::vector<double>{0, 0, 1, 0, 0, 1}));
}

TEST(Polygon, volume_is_area_times_thickness) {
  const Scene scene = read_text(polygon, "drop.toml");
  EXPECT_DOUBLE_EQ(scene.bodies[0].volume(0, 0.1), 0.5e-6 * 0.1);
}

TEST(Polygon, that_is_none_is_refused_with_the_place) {
  const auto problem = [](const std::string& vertices) {
    return error_of(with(polygon, "[0, 0, 1e-3, 0, 0, 1e-3]", vertices));
  };
  const std::string place = "drop.toml:27: bodies.0.vertices must ";
  EXPECT_EQ(problem("[0, 0, 1, 0]"), place + "hold x, y of three vertices or more; got [0, 0, 1, 0]");
  EXPECT_EQ(problem("[0, 0, 1, 0, 1]"), place + "hold x, y of three vertices or more; got [0, 0, 1, 0, 1]");
  EXPECT_EQ(problem("[0, 0, 1, 1, 1, 0, 0, 1]"),
            place +
                "not cross or touch itself: the sides from vertex 0 and from vertex 2 meet; got "
                "[0, 0, 1, 1, 1, 0, 0, 1]");
  EXPECT_EQ(problem("[0, 0, 1, 0, 1, 0, 0, 1]"),
            place + "not repeat a vertex: 1 and 2 are the same; got [0, 0, 1, 0, 1, 0, 0, 1]");
  EXPECT_EQ(problem("[0, 0, 2, 0, 1, 0]"),
            place + "not fold back on itself, as it does at vertex 1; got [0, 0, 2, 0, 1, 0]");
  EXPECT_EQ(problem("[0, 0, 2, 0, 2, 2, 1, 0, 0, 2]"),
            place +
                "not cross or touch itself: the sides from vertex 0 and from vertex 2 meet; got "
                "[0, 0, 2, 0, 2, 2, 1, 0, 0, 2]");
}

TEST(Polygon, that_moves_freely_or_among_free_bodies_is_refused) {
  EXPECT_EQ(error_of(with(polygon, "\"fixed\"", "\"free\"")),
            "drop.toml:29: bodies.0.motion must be \"fixed\" or \"prescribed\" for a polygon: there is no "
            "contact law for polygons yet; got \"free\"");
  const std::string disc = "[[bodies]]\nname = \"b\"\nradius = 1\ndensity = 1\nposition = [1, 1]\n";
  EXPECT_EQ(
      error_of(polygon + disc),
      "drop.toml:26: bodies.0.shape must not be \"polygon\" where other bodies move freely: there is no "
      "contact law for polygons yet; got \"polygon\"");
}

TEST(Polygon, and_disc_do_not_mix_their_keys) {
  EXPECT_EQ(error_of(with(polygon, "vertices =", "radius = 1\nvertices =")),
            "drop.toml:27: bodies.0.radius goes with discs and spheres only: remove it; got 1");
  EXPECT_EQ(error_of(with(settling, "radius =", "vertices = [0, 0, 1, 0, 0, 1]\nradius =")),
            "drop.toml:26: bodies.0.vertices goes with shape = \"polygon\" only: remove it; got [0, 0, 1, 0, "
            "0, 1]");
}

}  // namespace
}  // namespace fpi::scene
