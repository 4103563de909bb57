/// What a scene does beyond its own folder is told.
#include "setup/beyond_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../temporary_folder.hpp"
#include "run/stages.hpp"

namespace fpi {
namespace {

namespace fs = std::filesystem;

/// Of a dry scene in `folder`/here with one wall from a file.
std::vector<std::string> told_of(const TemporaryFolder& folder, const std::string& file,
                                 const std::string& more = "") {
  fs::create_directory(folder / "here");
  std::ofstream(folder / "here/scene.toml")
      << "time = {step = 0.1, end = 1}\n[[bodies]]\nname = \"ball\"\nradius = 0.1\ndensity = 1\n"
         "shape = \"sphere\"\nposition = [0, 0, 0]\n[[materials]]\nname = \"glass\"\nyoungs_modulus = 1e6\n"
         "[[walls]]\nname = \"cup\"\nshape = \"mesh\"\nfile = \""
      << file << "\"\n"
      << more;
  return beyond_folder(read_staged(folder / "here/scene.toml", {}, folder / "stages"),
                       folder / "here/scene.toml");
}

TEST(BeyondFolder, files_beside_the_scene_and_below_are_its_own) {
  const TemporaryFolder folder;
  EXPECT_TRUE(told_of(folder, "cup.stl").empty());
  EXPECT_TRUE(told_of(folder, "walls/../walls/cup.stl").empty());
}

TEST(BeyondFolder, files_elsewhere_are_named_links_followed) {
  const TemporaryFolder folder;
  std::ofstream(folder / "cup.stl") << "solid";
  EXPECT_EQ(told_of(folder, "../cup.stl").at(0),
            "reads a file outside its folder: " + (folder / "here/../cup.stl"));
  EXPECT_EQ(told_of(folder, "/etc/hostname").at(0), "reads a file outside its folder: /etc/hostname");
  fs::create_symlink("../cup.stl", folder / "here/cup.stl");
  EXPECT_EQ(told_of(folder, "cup.stl").size(), 1u);
}

TEST(BeyondFolder, programs_that_are_started_are_named) {
  const TemporaryFolder folder;
  EXPECT_EQ(told_of(folder, "cup.stl", "[dem]\ncommand = \"my_solver --fast\"\n").at(0),
            "starts a program for dem: `my_solver --fast`");
}

}  // namespace
}  // namespace fpi
