/// Scenes that go on from where the grains of another one came to rest.
#include "run/stages.hpp"

#include <gtest/gtest.h>

#include "../temporary_folder.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "grains/expand.hpp"
#include "results/end_state.hpp"
#include "run/json.hpp"
#include "run/run_folder.hpp"

namespace fpi {
namespace {

const std::string packing =
    "gravity = [0, -9.81]\ntime = {step = 1, end = 1}\nmaterials = [{name = \"m\", youngs_modulus = 1e6}]\n"
    "periodic = {x = [0, 1]}\n[[bodies]]\nname = \"a\"\nradius = 0.1\nposition = [0.1, 3]\ndensity = 1\n"
    "[[bodies]]\nname = \"post\"\nradius = 0.1\nposition = [0.5, 0.5]\nmotion = \"fixed\"\n"
    "[[bodies]]\nname = \"b\"\nradius = 0.2\nposition = [0.6, 5]\ndensity = 1\n";
const std::string flow =
    "gravity = [0, -9.81]\ntime = {step = 1, end = 1}\nmaterials = [{name = \"m\", youngs_modulus = 1e6}]\n"
    "[[grains]]\nname = \"bed\"\ngenerator = \"scene\"\nfile = \"packing.toml\"\ndensity = 2\n";

class Stages : public testing::Test {
 protected:
  Stages() {
    put("packing.toml", packing);
    put("flow.toml", flow);
  }
  void put(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  StagedScene read() { return read_staged(folder_ / "flow.toml", {}, folder_ / "runs"); }

  /// As a run of the packing would leave its folder.
  void run_packing(const std::string& by_version) {
    scene::Scene scene = scene::read_file(folder_ / "packing.toml");
    const std::string out = folder_ / "runs/packing";
    std::filesystem::create_directories(out);
    CoupledState state;
    state.motions.resize(3);
    state.left.resize(3);
    std::vector<coupling::RigidMotion>& motions = state.motions;
    motions[0].position = {1.25, 0.1, 0};
    motions[2].position = {0.5, 0.5, 0};
    motions[2].velocity = {3, 4, 0};
    motions[2].spin = {0, 0, 5};
    write_final_bodies(scene, state, out);
    Summary summary;
    summary.origin = {by_version, fingerprint(inputs_of(scene, {}))};
    summary.status = "completed";
    std::ofstream(out + "/summary.json") << to_json(summary);
  }

  TemporaryFolder folder_;
};

TEST_F(Stages, grains_are_where_the_free_bodies_of_the_stage_ended) {
  run_packing(version);
  StagedScene staged = read();
  ASSERT_EQ(staged.stages.size(), 1u);
  EXPECT_TRUE(staged.stages[0].ready);
  const Files files = read_files(staged, folder_ / "flow.toml");
  grains::expand(staged.scene, [&](const std::string& name) { return proto::content(files, name); });
  const auto& bodies = staged.scene.bodies;
  ASSERT_EQ(bodies.size(), 2u) << "the fixed one is none of them";
  EXPECT_EQ(bodies[0].position, (std::vector{0.25, 0.1})) << "inside the periodic box";
  EXPECT_EQ(bodies[0].radius, 0.1);
  EXPECT_EQ(bodies[0].density, 2) << "as the group says";
  EXPECT_EQ(bodies[1].velocity, (std::vector<double>{3, 4}));
  EXPECT_EQ(bodies[1].spin, (std::vector<double>{5}));
}

TEST_F(Stages, the_run_folder_alone_is_enough_to_go_on_with) {
  run_packing(version);
  StagedScene staged = read();
  const Files files = read_files(staged, folder_ / "flow.toml");
  const std::uint64_t fingerprint = make_plan(staged, files).scene_fingerprint;
  write_inputs(folder_.path(), staged.scene, files);
  StagedScene again = read_staged(folder_ / "scene.toml", {}, "nowhere");
  EXPECT_TRUE(again.stages.empty());
  const Files same = read_files(again, folder_ / "scene.toml");
  EXPECT_EQ(same[0].bytes, files[0].bytes);
  EXPECT_EQ(make_plan(again, same).scene_fingerprint, fingerprint);
}

TEST_F(Stages, a_stage_is_run_again_after_a_change_of_its_scene_or_by_another_version) {
  EXPECT_FALSE(read().stages[0].ready) << "never run";
  run_packing("0.0.1");
  EXPECT_FALSE(read().stages[0].ready);
  run_packing(version);
  EXPECT_TRUE(read().stages[0].ready);
  put("packing.toml", "thickness = 2\n" + packing);
  StagedScene staged = read();
  EXPECT_FALSE(staged.stages[0].ready);
  try {
    read_files(staged, folder_ / "flow.toml");
    FAIL() << "an old packing was taken";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("coupler --scene " + (folder_ / "packing.toml")), std::string::npos)
        << e.what();
  }
}

TEST_F(Stages, what_a_stage_ended_with_is_part_of_the_fingerprint) {
  StagedScene before = read();
  const Files none = read_files(find_files(before, folder_ / "flow.toml", Unready::leave_out), "");
  EXPECT_TRUE(none.empty());
  run_packing(version);
  const auto fingerprint_now = [this] {
    StagedScene staged = read();
    const Files files = read_files(staged, folder_ / "flow.toml");
    return make_plan(staged, files).scene_fingerprint;
  };
  const std::uint64_t first = fingerprint_now();
  EXPECT_NE(make_plan(before, none).scene_fingerprint, first);
  std::ofstream(folder_ / "runs/packing/final_bodies.csv", std::ios::app) << "0.9,9,0.1,0,0,0\n";
  EXPECT_NE(fingerprint_now(), first);
}

TEST_F(Stages, a_stage_that_has_a_stage_itself_is_refused) {
  put("packing.toml", flow);
  EXPECT_THROW(read(), Error);
}

}  // namespace
}  // namespace fpi
