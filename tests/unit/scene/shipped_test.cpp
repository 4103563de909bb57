/// The scenes that come with the project, and the reference of all keys, are up to date.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "scenes.hpp"

namespace fpi::scene {
namespace {

const std::filesystem::path root = FPI_ROOT;

TEST(Shipped, every_scene_is_read_and_says_its_source_and_what_to_expect) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "configs")) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    const Scene scene = read_file(entry.path());
    EXPECT_FALSE(scene.title.empty()) << entry.path();
    EXPECT_FALSE(scene.source.empty()) << entry.path();
    EXPECT_FALSE(scene.expected.empty()) << entry.path();
    const std::string text = write_text(scene);
    EXPECT_EQ(write_text(read_text(text, "written")), text) << entry.path();
  }
  EXPECT_GE(scenes, 5);
}

TEST(Shipped, the_reference_in_docs_is_that_of_the_declarations) {
  std::ostringstream text;
  text << std::ifstream(root / "docs" / "scene_reference.md").rdbuf();
  EXPECT_EQ(text.str(), reference())
      << "run: build/release/bin/coupler --reference > docs/scene_reference.md";
}

}  // namespace
}  // namespace fpi::scene
