/// Bodies that leave the scene while it runs: who, when, and what is left of them.
#include "step/outlets.hpp"

#include "results/groups.hpp"
#include "results/onset_drives.hpp"
#include "run_case.hpp"

namespace fpi {
namespace {

/// Two discs fall; the lower one is wholly below y = 1 some steps before the other.
scene::Scene falling() {
  scene::Scene scene = make_scene({disc("low", "free"), disc("high", "free")});
  scene.bodies[1].position = {2, 4};
  scene.outlets = {{.name = "elsewhere", .lower = {5, -9}, .upper = {9, 9}},
                   {.name = "below", .lower = {-9, -9}, .upper = {9, 1}}};
  scene.time.end = 3;
  return scene;
}

struct Leaving : RunTest {
  Leaving() : RunTest({{0, 3, 0}, {2, 4, 0}}) {}
};

TEST_F(Leaving, a_body_leaves_with_the_first_step_that_ends_with_all_of_it_in_an_outlet) {
  const scene::Scene scene = falling();
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const output::Columns left = output::read_columns(folder / "left_bodies.csv");
  ASSERT_EQ(left.at("body"), (std::vector<double>{0, 1}));
  EXPECT_EQ(left.at("outlet"), (std::vector<double>{1, 1}));
  EXPECT_LT(left.at("time")[0], left.at("time")[1]);
  for (const std::size_t k : {0, 1}) {
    EXPECT_LE(left.at("y")[k], 0.5);
    EXPECT_GT(left.at("y")[k] - 0.1 * left.at("vy")[k], 0.5) << "it was not below a step before";
  }
  EXPECT_EQ(dem.left, (std::vector<std::uint32_t>{0, 1}));
}

TEST_F(Leaving, nothing_is_lost_of_mass_and_momentum) {
  const scene::Scene scene = falling();
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const output::Columns left = output::read_columns(folder / "left_bodies.csv");
  const output::Columns history = output::read_columns(folder / "history.csv");
  EXPECT_EQ(history.at("below.count").back(), 2);
  EXPECT_EQ(history.at("below.mass").back(), left.at("mass")[0] + left.at("mass")[1]);
  EXPECT_EQ(history.at("below.momentum_y").back(),
            left.at("mass")[0] * left.at("vy")[0] + left.at("mass")[1] * left.at("vy")[1]);
  EXPECT_EQ(history.at("elsewhere.count").back(), 0);
}

TEST_F(Leaving, the_fluid_is_asked_no_more_about_a_body_that_left_and_the_others_go_on_alike) {
  const scene::Scene scene = falling();
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_EQ(fluid.asked.front().interfaces.size(), 2u);
  EXPECT_EQ(fluid.asked.back().interfaces.size(), 0u);
  const auto alone = std::ranges::find(fluid.asked, 1u, [](const auto& m) { return m.interfaces.size(); });
  ASSERT_NE(alone, fluid.asked.end());
  EXPECT_EQ(alone->interfaces[0].body, 1u);
  const output::Columns left = output::read_columns(folder / "left_bodies.csv");
  double v = 0, y = 4;
  for (double t = 0; t < left.at("time")[1] - 0.05; t += 0.1) {
    const double before = v;
    v = ((1 + 3) * v + 0.1 * (0.5 + gravity)) / (1 + 3 + 2 * 0.1);
    y += 0.05 * (before + v);
  }
  EXPECT_NEAR(left.at("y")[1], y, 1e-4);
}

TEST_F(Leaving, a_body_that_left_has_no_place_in_the_results_and_rests) {
  scene::Scene scene = falling();
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const output::H5File file = output::H5File::read(folder / "bodies.h5");
  const std::vector<double> position = file.doubles("/position");
  EXPECT_TRUE(std::isfinite(position[1])) << "there at first";
  EXPECT_TRUE(std::isnan(position.back()));
  const CoupledState& state = run.problem().state();
  EXPECT_TRUE(state.motions[0].velocity.isZero(0));
  scene::Grains& group = scene.grains.emplace_back();
  group.name = "grain";
  group.count = 2;
  EXPECT_EQ(group_motions(scene, state)[0].count, 0u);
  EXPECT_TRUE(group_motions(scene, state)[0].position.hasNaN());
}

TEST_F(Leaving, a_resumed_run_knows_who_left) {
  scene::Scene scene = falling();
  scene.output.checkpoint_every = 7;  // between the two departures, and after both
  std::vector<std::string> histories;
  {
    CoupledRun run = make_run(scene);
    run.start({});
    run.march();
    histories.push_back(read_text_file(folder / "history.csv") + read_text_file(folder / "left_bodies.csv"));
  }
  const Checkpoint checkpoint = last_checkpoint_before_the_end(scene);
  CoupledRun resumed = make_run(scene);
  resumed.resume({}, checkpoint);
  resumed.march();
  histories.push_back(read_text_file(folder / "history.csv") + read_text_file(folder / "left_bodies.csv"));
  EXPECT_EQ(histories[0], histories[1]);
}

TEST_F(Leaving, the_onset_of_motion_has_its_time_its_body_and_what_drove_it) {
  scene::Scene scene = falling();
  scene.probes = {{.name = "p", .point = {0, 0}, .minus = {}}};
  scene.bodies[0].motion = "fixed";
  scene.output.onset = 0.5;  // of a diameter of 1 m
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const output::Columns history = output::read_columns(folder / "history.csv");
  const std::vector<double>& y = history.at("high.y");
  const auto first = std::ranges::find_if(y, [](double height) { return height < 3.5; }) - y.begin();
  const auto& onset = run.problem().state().onset;
  ASSERT_TRUE(onset);
  EXPECT_EQ(onset->body, 1u);
  EXPECT_EQ(onset->time, history.at("time")[static_cast<std::size_t>(first)]);
  EXPECT_EQ(drives_at(*onset, scene, folder.path()),
            (std::map<std::string, double>{{"p", history.at("p")[static_cast<std::size_t>(first)]}}));
  scene.output.onset = 0;
  EXPECT_FALSE(find_onset(scene, run.problem().state().motions, 1)) << "nobody asked";
}

TEST(Outlets, a_disc_leaves_as_a_whole_a_held_one_never) {
  const scene::Scene scene = [] {
    scene::Scene s = make_scene({disc("free", "free"), disc("held", "fixed")});
    s.outlets = {{.name = "out", .lower = {0, 0}, .upper = {1, 2}}};
    s.periodic.y = {0, 10};
    return s;
  }();
  CoupledState state;
  state.motions.resize(2);
  state.left.resize(2);
  const auto leaves_at = [&](double x, double y) {
    for (coupling::RigidMotion& motion : state.motions) motion.position = {x, y, 0};
    const auto found = departures(scene, state);
    EXPECT_TRUE(found.empty() || (found.size() == 1 && found[0].body == 0));
    return !found.empty();
  };
  EXPECT_TRUE(leaves_at(0.5, 1));
  EXPECT_TRUE(leaves_at(0.5, 21)) << "as it is seen in the periodic box";
  EXPECT_FALSE(leaves_at(0.51, 1)) << "a bit of it sticks out";
  EXPECT_TRUE(is_at_outlet(scene, scene.bodies[0], {-0.4, 1, 0}));
  EXPECT_FALSE(is_at_outlet(scene, scene.bodies[0], {-0.6, 1, 0}));
  state.left[0] = true;
  EXPECT_FALSE(leaves_at(0.5, 1)) << "it left before";
}

/// Whether a disc of radius 0.5 that moves straight from one place to another leaves, and through which.
int outlet_between(const scene::Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  CoupledState state;
  state.motions.resize(1);
  state.left.resize(1);
  std::vector<coupling::RigidMotion> before(1);
  before[0].position = from;
  state.motions[0].position = to;
  const auto found = departures(scene, state, before);
  return found.empty() ? -1 : static_cast<int>(found[0].outlet);
}

TEST(Outlets, a_disc_leaves_that_is_in_the_outlet_at_any_moment_of_a_step) {
  scene::Scene scene = make_scene({disc("free", "free")});
  scene.outlets = {{.name = "far", .lower = {9, -1}, .upper = {10.5, 1}},
                   {.name = "near", .lower = {3, -1}, .upper = {4.5, 1}}};
  EXPECT_EQ(outlet_between(scene, {0, 0, 0}, {7, 0, 0}), 1) << "it jumps over it";
  EXPECT_EQ(outlet_between(scene, {20, 0, 0}, {-5, 0, 0}), 0) << "the first that it meets";
  EXPECT_EQ(outlet_between(scene, {0, 0, 0}, {20, 0, 0}), 1);
  EXPECT_EQ(outlet_between(scene, {0, 0.6, 0}, {7, 0.6, 0}), -1) << "a bit of it stays outside all along";
  EXPECT_EQ(outlet_between(scene, {2, 5, 0}, {7, -5, 0}), -1) << "never wholly inside";
  EXPECT_EQ(outlet_between(scene, {0, 0, 0}, {3.4, 0, 0}), -1);
}

TEST(Outlets, a_disc_leaves_wherever_the_planes_of_the_periodic_box_are) {
  scene::Scene scene = make_scene({disc("free", "free")});
  scene.periodic.x = {0, 10};
  scene.outlets = {{.name = "across", .lower = {-1, 0}, .upper = {2, 9}}};
  EXPECT_EQ(outlet_between(scene, {9.8, 5, 0}, {9.8, 5, 0}), 0);
  EXPECT_EQ(outlet_between(scene, {5, 5, 0}, {48, 5, 0}), 0);
  EXPECT_EQ(outlet_between(scene, {5, 5, 0}, {5, 5, 0}), -1);
  scene.outlets[0] = {.name = "all", .lower = {0, 0}, .upper = {10, 9}};
  EXPECT_EQ(outlet_between(scene, {9.9, 5, 0}, {9.9, 5, 0}), 0) << "it has no ends along x";
  EXPECT_TRUE(is_at_outlet(scene, scene.bodies[0], {9.9, 9.4, 0}));
}

}  // namespace
}  // namespace fpi
