#include "grains/expand.hpp"

#include <gtest/gtest.h>

#include "spheres.hpp"

namespace fpi::grains {
namespace {

const std::string post =
    "[[bodies]]\nname = \"post\"\nradius = 0.1\nposition = [0.5, 0.5]\nmotion = \"fixed\"\n";
const std::string sand =
    "[[grains]]\nname = \"sand\"\ngenerator = \"random\"\nlower = [0, 0]\nupper = [1, 1]\nradius_range = "
    "[0.01, "
    "0.02]\nsolid_fraction = 0.4\ndensity = 2500\nvelocity = [1, 2]\nmaterial = \"stone\"\n";
const std::string table =
    "[[grains]]\nname = \"shot\"\ngenerator = \"csv\"\nfile = \"shot.csv\"\ndensity = 1000\nvelocity = [7, "
    "8]\n";

TEST(Expand, adds_the_grains_after_the_bodies_that_are_listed) {
  const scene::Scene scene = expanded(post + sand);
  EXPECT_EQ(scene.n_listed(), 1u);
  ASSERT_EQ(scene.bodies.size(), 1 + scene.grains[0].count);
  double area = 0;
  std::vector<Sphere> spheres;
  for (const scene::Body& body : scene.bodies) {
    if (body.name != "post") area += body.volume(body.radius, 1);
    spheres.push_back({scene::to_vec3(body.position), body.radius});
  }
  EXPECT_NEAR(area, 0.4, 0.002);
  EXPECT_GT(narrowest_gap(spheres), 0);
  const scene::Body& grain = scene.bodies[18];
  EXPECT_EQ(grain.name, "sand.17");
  EXPECT_EQ(grain.density, 2500);
  EXPECT_EQ(grain.velocity, (std::vector<double>{1, 2}));
  EXPECT_EQ(grain.material, "stone");
  EXPECT_TRUE(grain.is_free());
  EXPECT_EQ(describe(scene).at(0).substr(0, 6), "sand: ");
}

TEST(Expand, gives_every_process_the_same_bodies) {
  const scene::Scene coupler = expanded(sand);
  scene::Scene other = scene::read_text(scene::write_text(coupler), "the scene sent by the coupler");
  EXPECT_EQ(other.bodies.size(), 0u) << "only the declaration is sent";
  expand(other, [](const std::string&) { return std::string_view(); });
  ASSERT_EQ(other.bodies.size(), coupler.bodies.size());
  for (std::size_t i = 0; i < other.bodies.size(); ++i) {
    EXPECT_EQ(other.bodies[i].position, coupler.bodies[i].position);
    EXPECT_EQ(other.bodies[i].radius, coupler.bodies[i].radius);
  }
}

TEST(Expand, takes_velocities_from_the_table_where_it_has_them) {
  const scene::Scene moving = expanded(table, "x,y,radius,vy\n0,0,1,3\n5,0,1,4\n");
  EXPECT_EQ(moving.bodies[1].name, "shot.1");
  EXPECT_EQ(moving.bodies[1].velocity, (std::vector<double>{0, 4}));
  const scene::Scene alike = expanded(table, "x,y,radius\n0,0,1\n5,0,1\n");
  EXPECT_EQ(alike.bodies[1].velocity, (std::vector<double>{7, 8}));
}

TEST(Expand, refuses_what_no_packing_can_reach) {
  std::string dense = sand;
  dense.replace(dense.find("0.4"), 3, "0.9");
  EXPECT_NE(error_of(dense).find("at 0.9 they jam"), std::string::npos) << error_of(dense);
  std::string tiny = sand;
  tiny.replace(tiny.find("[0.01, 0.02]"), 12, "[1e-6, 2e-6]");
  EXPECT_NE(error_of(tiny).find("must stand for at most 1e+07 grains"), std::string::npos) << error_of(tiny);
  std::string large = sand;
  large.replace(large.find("[0.01, 0.02]"), 12, "[1, 2]");
  EXPECT_NE(error_of(large).find("must have room for a grain"), std::string::npos) << error_of(large);
}

TEST(Expand, takes_a_fine_sieve_that_nothing_passes) {
  std::string graded = sand;
  const std::string range = "radius_range = [0.01, 0.02]";
  graded.replace(graded.find(range), range.size(), "sieve_sizes = [1e-6, 0.02, 0.04]\npassing = [0, 0, 100]");
  EXPECT_EQ(error_of(graded), "");
}

struct Refused {
  std::string from, to, message;
};

TEST(Grains, a_declaration_that_does_not_fit_is_refused_with_its_place) {
  const Refused cases[] = {
      {"radius_range = [0.01, 0.02]", "radius_range = [0.02, 0.01]",
       "radius_range must be [smallest, largest]"},
      {"radius_range = [0.01, 0.02]", "", "radius must be given, or else radius_range"},
      {"radius_range = [0.01, 0.02]", "sieve_sizes = [1, 2]\npassing = [0, 90]",
       "passing must rise from 0 to 100"},
      {"\"random\"", "\"hcp\"", "generator must be square, hexagonal, random, csv or scene for discs"},
      {"upper = [1, 1]", "upper = [1, 0]", "upper must be above lower"},
      {"upper = [1, 1]", "upper = [1, 1, 1]", "upper must have an entry for each axis"},
      {"solid_fraction = 0.4", "", "solid_fraction must be > 0 for a random packing"},
      {"solid_fraction = 0.4", "solid_fraction = 0.4\nspacing = 1", "spacing goes with lattices only"},
      {"density = 2500", "", "density is required"},
      {"density = 2500", "density = 0", "density must be > 0 kg/m³ of a free body where there is no fluid"},
      {"\"stone\"", "\"stne\"", "material must name one of [[materials]] (did you mean \"stone\"?)"},
      {"\"sand\"", "\"a b\"", "name must be a word"},
      {"\"sand\"", "\"post\"", "name must not be the name of a body"},
  };
  for (const auto& [from, to, message] : cases) {
    std::string text = post + sand;
    text.replace(text.find(from), from.size(), to);
    EXPECT_NE(error_of(text).find("grains.0." + message), std::string::npos) << error_of(text);
    EXPECT_EQ(error_of(text).find("sand.toml:"), 0u) << error_of(text);
  }
}

}  // namespace
}  // namespace fpi::grains
