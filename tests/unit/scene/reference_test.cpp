/// The reference of all keys.
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace fpi::scene {
namespace {

TEST(Reference, mentions_every_key_that_a_written_scene_has) {
  const std::string markdown = reference();
  std::istringstream text(write_text(read_text(settling, "drop.toml")));
  int keys = 0;
  for (std::string line; std::getline(text, line);) {
    const std::size_t equals = line.find(" = ");
    if (equals == std::string::npos) continue;
    ++keys;
    EXPECT_NE(markdown.find("| `" + line.substr(0, equals) + "` |"), std::string::npos) << line;
  }
  EXPECT_GT(keys, 60);
}

TEST(Reference, gives_unit_default_bounds_and_meaning) {
  EXPECT_NE(reference().find("| `density` | kg/m³ | required | > 0 | fluid density ρ |"), std::string::npos);
  EXPECT_NE(reference().find("| `newmark_gamma` |  | `0.5` | in [0.5, 1] |"), std::string::npos);
  EXPECT_NE(reference().find("| `dynamic_viscosity` | Pa s | none | > 0 |"), std::string::npos);
}

TEST(Reference, has_a_section_for_every_table) {
  for (const char* section : {"[time]", "[fluid]", "[fluid.mesh]", "[fluid.boundaries.NAME]", "[dem]",
                              "[[bodies]]", "[[materials]]", "[[walls]]", "[coupling]", "[output]",
                              "[[coefficients]]", "[[probes]]", "[[profiles]]", "[exact]"}) {
    EXPECT_NE(reference().find(fmt::format("\n## `{}`\n", section)), std::string::npos) << section;
  }
}

}  // namespace
}  // namespace fpi::scene
