/// Writing a scene back, whole or as the part of a participant.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "scene/toml_text.hpp"
#include "scenes.hpp"

namespace fpi::scene {
namespace {

/// A scene whose every group is there.
const std::string everything = settling + R"(
[coefficients]
on = "disc"
velocity = 0.2
length = 0.1

[[probes]]
name = "front"
point = [0.15, 0.2]
minus = [0.25, 0.2]

[[profiles]]
name = "middle"
quantity = "velocity_x"
from = [0, 0.2]
to = [0.4, 0.2]

[exact]
velocity = ["y", 0]
pressure = "-x"

[output]
interval = 0.1
measure_from = 0.05
)";

TEST(Writer, gives_text_that_reads_back_to_the_same_text) {
  const std::string text = write_text(read_text(everything, "drop.toml"));
  EXPECT_EQ(write_text(read_text(text, "written")), text);
}

TEST(Writer, fills_in_every_default) {
  const std::string text = write_text(read_text(settling, "drop.toml"));
  for (const char* line : {"thickness = 1.0", "acceleration = \"iqn-imvj\"", "max_halvings = 6", "[dem]",
                           "[fluid.embedding]", "newmark_gamma = 0.5", "motion = \"free\""}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
  EXPECT_EQ(text.find("dynamic_viscosity"), std::string::npos) << "what is absent stays absent";
}

TEST(Writer, keeps_every_bit_of_a_number) {
  Scene scene = read_text(settling, "drop.toml");
  for (const double value : {0.1 + 0.2, 1.0 / 3, 5e-324, 9.999999999999999e49, 1e22, 123456789012345680.0,
                             -0.0, 9007199254740993.0, std::nextafter(1.0, 2.0)}) {
    scene.bodies[0].position = {value, -value};
    const Scene back = read_text(write_text(scene), "written");
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back.bodies[0].position[0]), std::bit_cast<std::uint64_t>(value));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back.bodies[0].position[1]), std::bit_cast<std::uint64_t>(-value));
  }
}

TEST(Writer, escapes_strings_and_quotes_odd_names) {
  Scene scene = read_text(settling, "drop.toml");
  scene.title = "a \"quoted\" \\ line\nand\ttab, é";
  scene.fluid->mesh = Mesh{.file = "box.msh",
                           .lower = {},
                           .upper = {},
                           .fine_region = {},
                           .free_bodies_box = {},
                           .refinements = {},
                           .circles = {}};
  scene.fluid->boundaries["the inlet"].type = "no_slip";
  const Scene back = read_text(write_text(scene), "written");
  EXPECT_EQ(back.title, scene.title);
  EXPECT_TRUE(back.fluid->boundaries.contains("the inlet"));
}

TEST(PartFor, the_fluid_leaves_out_the_grains) {
  const Scene part = read_text(write_text(part_of(Part::fluid, read_text(everything, "drop.toml"))), "part");
  EXPECT_TRUE(part.fluid);
  EXPECT_EQ(part.bodies.size(), 1u);
  EXPECT_EQ(part.probes.size(), 1u);
  EXPECT_EQ(part.coefficients.size(), 1u);
  EXPECT_EQ(part.profiles.size(), 1u);
  EXPECT_TRUE(part.exact);
  EXPECT_TRUE(part.walls.empty());
}

TEST(PartFor, the_fluid_checks_materials_by_the_law_of_the_contacts) {
  const std::string soft = with(settling, "youngs_modulus = 1e6", "normal_stiffness = 20");
  const Scene scene = read_text(soft + "[dem]\ncontact = \"linear\"\nstart_overlap = 0.3\n", "drop.toml");
  const Scene part = read_text(write_text(part_of(Part::fluid, scene)), "part");
  EXPECT_EQ(part.dem.value().start_overlap, 0.3)
      << "grains that overlap more are refused by every participant";
}

TEST(PartFor, the_dem_leaves_out_the_fluid) {
  Scene scene = read_text(everything, "drop.toml");
  scene.time.relative_tolerance = 1e-3;
  const Scene part = read_text(write_text(part_of(Part::dem, scene)), "part");
  EXPECT_EQ(part.time.relative_tolerance, 0);
  EXPECT_FALSE(part.fluid);
  EXPECT_TRUE(part.dem);
  EXPECT_EQ(part.walls.size(), 1u);
  EXPECT_EQ(part.materials.size(), 1u);
  EXPECT_TRUE(part.probes.empty());
  EXPECT_TRUE(part.coefficients.empty());
  EXPECT_TRUE(part.profiles.empty());
  EXPECT_FALSE(part.exact);
  EXPECT_EQ(part.gravity[1], -9.81);
}

TEST(Fingerprint, is_that_of_the_meaning_and_not_of_the_text) {
  const Scene scene = read_text(settling, "drop.toml");
  EXPECT_EQ(fingerprint(scene), fingerprint(read_text("# a remark\n" + settling, "other.toml")));
  EXPECT_NE(fingerprint(scene), fingerprint(read_text(settling, "drop.toml", {"fluid.density=1001"})));
  EXPECT_EQ(fingerprint(scene),
            fingerprint(read_text(settling, "drop.toml", {"fluid.external=true", "title=\"another\""})));
}

TEST(TomlText, writes_reals_so_that_they_stay_reals) {
  EXPECT_EQ(toml_text(1.0), "1.0");
  EXPECT_EQ(toml_text(0.1), "0.1");
  EXPECT_EQ(toml_text(-0.0), "-0.0");
  EXPECT_EQ(toml_text(std::vector<double>{}), "[]");
}

}  // namespace
}  // namespace fpi::scene
