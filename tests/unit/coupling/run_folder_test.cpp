/// What a run folder says of its run: whether it is under way, and how it ended.
#include "run/run_folder.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../temporary_folder.hpp"
#include "core/error.hpp"
#include "run/json.hpp"

namespace fpi {
namespace {

TEST(FolderLock, a_folder_belongs_to_one_run_until_it_ends) {
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_THROW(FolderLock{folder.path()}, Error);
  }
  EXPECT_NO_THROW(FolderLock{folder.path()});
}

TEST(ReadFiles, files_are_found_beside_the_scene_and_kept_by_their_names_alone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "meshes");
  std::ofstream(folder / "meshes/square.msh") << "a mesh";
  StagedScene staged;
  scene::Scene& scene = staged.scene;
  scene.fluid.emplace().mesh.file = "meshes/square.msh";
  const Files files = read_files(staged, folder / "drop.toml");
  EXPECT_EQ(scene.fluid->mesh.file, "square.msh");
  EXPECT_EQ(proto::content(files, "square.msh"), "a mesh");
  EXPECT_THROW(proto::content(files, "circle.msh"), Error);
  EXPECT_THROW(read_files(staged, folder / "drop.toml"), Error) << "no longer beside the scene";
  write_inputs(folder.path(), scene, files);
  scene.fluid->mesh.file = "inputs/square.msh";  // as scene.toml says now
  EXPECT_NE(read_text_file(folder / "scene.toml").find("\"inputs/square.msh\""), std::string::npos);
  EXPECT_EQ(proto::content(read_files(staged, folder / "scene.toml"), "square.msh"), "a mesh");
}

TEST(RequireOutside, a_run_does_not_write_where_it_reads) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "runs/old");
  std::filesystem::create_directory_symlink(folder / "runs/old", folder / "link");
  std::ofstream(folder / "runs/old/final_bodies.csv") << "x,y,radius\n";
  const std::vector<InputFile> table{{"final_bodies.csv", folder / "runs/old/final_bodies.csv"}};
  EXPECT_NO_THROW(require_outside(folder / "runs/new", folder / "scene.toml", table));
  EXPECT_NO_THROW(require_outside(folder / "runs/ol", folder / "scene.toml", table)) << "another name";
  EXPECT_THROW(require_outside(folder / "runs/old", folder / "scene.toml", table), Error);
  EXPECT_THROW(require_outside(folder / "link", folder / "scene.toml", table), Error);
  EXPECT_THROW(require_outside(folder / "runs", folder / "scene.toml", table), Error) << "below it";
  EXPECT_THROW(require_outside(folder.path(), folder / "scene.toml", {}), Error);
}

TEST(ClearFolder, results_and_what_was_not_finished_go_and_all_else_stays) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "fields");
  for (const char* name :
       {"history.csv", "fields/000000.h5", "checkpoint.previous.bin", "fields.h5.new", "notes.txt"})
    std::ofstream(folder / name) << "old";
  clear_folder(folder.path());
  remove_unfinished(folder.path());
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    left.push_back(entry.path().filename());
  EXPECT_EQ(left, std::vector<std::string>{"notes.txt"});
}

TEST(Json, a_summary_says_null_for_a_lost_participant_and_zero_for_one_not_needed) {
  Summary summary;
  summary.figures["fluid"] = {};
  const std::string text = to_json(summary);
  EXPECT_NE(text.find("\"fluid_server\": null"), std::string::npos) << text;
  EXPECT_NE(text.find("\"dem_server\": 0"), std::string::npos) << text;
  EXPECT_NE(text.find("\"status\": \"failed\""), std::string::npos) << text;
}

TEST(Json, a_summary_sorts_the_figures_of_the_fluid) {
  Summary summary;
  summary.figures["fluid"] = {{"seconds:mesh", 0.5},
                              {"seconds:refinement", 0.25},
                              {"factorisations", 3},
                              {"min:u", -0.2},
                              {"min_x:u", 0.5},
                              {"min_y:u", 0.125},
                              {"centre_x:wall", 0.75},
                              {"centre_y:wall", 1},
                              {"error:velocity_l2", 1e-3},
                              {"peak_memory_bytes", 9},
                              {"max:u", 1}};
  summary.profile_names = {"u"};
  summary.boundary_names = {"wall"};
  summary.boundaries = {{.fx = 1, .fy = 2, .torque = 3}};
  const auto json = nlohmann::json::parse(to_json(summary));
  EXPECT_EQ(json["wall_seconds"]["refinement"], 0.25);
  EXPECT_EQ(json["counts"]["fluid"], (nlohmann::json{{"factorisations", 3.0}}));
  EXPECT_EQ(json["profiles"]["u"]["min"], -0.2);
  EXPECT_EQ(json["profiles"]["u"]["min_at"], (nlohmann::json{0.5, 0.125}));
  EXPECT_TRUE(json["profiles"]["u"]["max_at"][0].is_null()) << "the fluid did not say";
  EXPECT_EQ(json["boundaries"][0]["torque"], (nlohmann::json{0, 0, 3.0}));
  EXPECT_EQ(json["boundaries"][0]["centre"], (nlohmann::json{0.75, 1.0, 0}));
  EXPECT_EQ(json["errors"], (nlohmann::json{{"velocity_l2", 1e-3}}));
}

TEST(Json, only_the_summary_of_a_completed_run_says_of_what_it_was) {
  Summary summary;
  summary.origin = {"1.2", 0xfedcba9876543210};
  EXPECT_FALSE(origin_if_completed(to_json(summary)));
  summary.status = "completed";
  EXPECT_EQ(origin_if_completed(to_json(summary)), summary.origin);
  for (const char* text : {"", "{", "[]", "{\"status\": 1}", "{\"status\": \"completed\"}"})
    EXPECT_FALSE(origin_if_completed(text)) << text;
}

}  // namespace
}  // namespace fpi
