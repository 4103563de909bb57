/// The run loop: steps, those that fail, and what participants are asked.
#include "run_case.hpp"

namespace fpi {
namespace {

TEST_F(RunTest, a_falling_body_follows_the_implicit_solution_of_its_equation) {
  const scene::Scene scene = make_scene({disc("ball", "free")});
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  double v = 0, y = 3;
  for (int k = 0; k < 12; ++k) {
    const double before = v;
    v = ((1 + 3) * v + 0.1 * (0.5 + gravity)) / (1 + 3 + 2 * 0.1);
    y += 0.05 * (before + v);
  }
  const coupling::RigidMotion& motion = run.problem().state().motions[0];
  EXPECT_NEAR(motion.velocity.y(), v, 1e-5 * std::abs(v));
  EXPECT_NEAR(motion.position.y(), y, 1e-5);
  EXPECT_EQ(run.statistics().steps(), 12u);
  EXPECT_LE(run.statistics().max_sub_iterations(), 4u);  // the added mass is three times the body's
}

TEST_F(RunTest, the_geometry_is_frozen_in_a_step_and_only_velocities_change) {
  const scene::Scene scene = make_scene({disc("ball", "free")});
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  bool velocities_changed = false;
  for (std::size_t k = 1; k < fluid.asked.size(); ++k) {
    if (fluid.stamps[k].step != fluid.stamps[k - 1].step) continue;
    const proto::Interface &now = fluid.asked[k].interfaces[0], &before = fluid.asked[k - 1].interfaces[0];
    EXPECT_EQ(now.centre, before.centre);
    EXPECT_EQ(now.start, before.start);
    EXPECT_EQ(fluid.stamps[k].sub_iteration, fluid.stamps[k - 1].sub_iteration + 1);
    velocities_changed |= now.translation != before.translation;
  }
  EXPECT_TRUE(velocities_changed);
}

TEST_F(RunTest, the_fluid_sees_the_hydraulic_radius) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.hydraulic_radius_ratio = 0.8;
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_DOUBLE_EQ(fluid.asked[0].interfaces[0].radius, 0.4);
}

/// Something besides its weight acts on the ball: a damper, far stiffer than the fluid's drag.
TEST_F(RunTest, where_more_than_weight_acts_the_dem_gets_the_resistance_of_the_fluid) {
  const scene::Scene scene = make_scene({disc("ball", "free")});
  for (const double damper : {0.0, 400.0}) {
    FakeFluid own_fluid;
    FakeDem own_dem = new_dem();
    own_dem.damper = damper;
    TemporaryFolder own;
    CoupledRun run(scene, {&own_fluid, &own_dem, true, true, true}, own.path(), 1, timers);
    run.start({});
    run.march();
    double v = 0;
    for (int k = 0; k < 12; ++k) v = ((1 + 3) * v + 0.1 * (0.5 + gravity)) / (1 + 3 + (2 + damper) * 0.1);
    EXPECT_NEAR(run.problem().state().motions[0].velocity.y(), v, 1e-5 * std::abs(v));
    // Known from the first step on what acts, each step is foreseen, or corrected once.
    EXPECT_LE(own_fluid.asked.size(), damper > 0 ? 24u : 12u);
    const auto wanted = std::ranges::count_if(own_fluid.asked, &proto::FluidAdvance::wants_resistance);
    EXPECT_EQ(wanted, damper > 0 ? 12 : 0);
    EXPECT_EQ(own_dem.asked.back().resistance.size(), damper > 0 ? 9u : 0u);
  }
}

TEST_F(RunTest, prescribed_and_fixed_bodies_take_one_exchange_a_step_and_move_by_their_formulas) {
  const scene::Scene scene = make_scene({disc("stirrer", "prescribed"), disc("post", "fixed")});
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_EQ(fluid.asked.size(), 12u);
  const auto& last = fluid.asked.back();
  EXPECT_NEAR(last.interfaces[0].centre[0], std::sin(1.2), 1e-13);
  EXPECT_NEAR(last.interfaces[0].translation[0], std::cos(1.2), 1e-13);
  EXPECT_EQ(last.interfaces[1].centre, (proto::Vec3{0, 3, 0}));
}

TEST_F(RunTest, steps_whose_error_in_time_is_too_large_are_restored_and_repeated_smaller) {
  scene::Scene scene = make_scene({disc("post", "fixed")});
  scene.time.relative_tolerance = 1e-3;
  fluid.stiffness = 1000;  // the tolerance is met at 0.01 s; the first step has 0.1 s
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_GT(fluid.restores, 0u);
  EXPECT_EQ(fluid.asked.size(), fluid.accepts + fluid.restores);
  EXPECT_DOUBLE_EQ(fluid.asked.back().time, 1.2);
  for (std::size_t k = fluid.restores; k < fluid.asked.size(); ++k)
    EXPECT_NEAR(fluid.asked[k].time_step, 0.009, 0.0012);
}

TEST_F(RunTest, bodies_go_no_farther_in_a_step_than_allowed_and_the_end_is_hit) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.time.max_displacement = 0.5;
  const double h = fluid.arc_length / scene.fluid->embedding.arc_ratio;
  CoupledRun run = make_run(scene);
  run.start({});
  double last = 3, largest = 0;
  run.on_progress = [&](const RunProgress&) {
    const double y = run.problem().state().motions[0].position.y();
    largest = std::max(largest, std::abs(y - last) / h);
    last = y;
  };
  run.march();
  EXPECT_EQ(run.progress().time, 1.2);
  EXPECT_LE(largest, 0.5);
  EXPECT_GT(largest, 0.35);
  EXPECT_GT(run.statistics().repeated(), 0u);
  EXPECT_EQ(run.statistics().rejected(), 0u);
}

TEST_F(RunTest, the_geometry_is_cut_anew_where_a_body_was_missed_by_more_than_allowed) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  const auto recuts = [&](double above, const char* predictor) {
    scene.coupling.recut_above = above;
    scene.coupling.predictor = predictor;
    FakeFluid own_fluid;
    FakeDem own_dem = new_dem();
    const TemporaryFolder own_folder;
    CoupledRun run(scene, {&own_fluid, &own_dem}, own_folder.path(), 1, timers);
    run.start({});
    run.march();
    EXPECT_TRUE(above == 0 || run.statistics().largest_miss() <= above);
    return run.statistics().recuts();
  };
  EXPECT_EQ(recuts(0, "constant"), 0u);
  EXPECT_GT(recuts(0.05, "constant"), 6u);
  EXPECT_LT(recuts(0.05, "auto"), 3u);
}

TEST_F(RunTest, a_body_is_cut_where_it_was_until_it_has_moved_by_what_is_allowed) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.coupling.recut_above = 0;
  const double h = fluid.arc_length / scene.fluid->embedding.arc_ratio;
  const auto places = [&](double hold_below) {
    scene.coupling.hold_below = hold_below;
    FakeFluid own_fluid;
    FakeDem own_dem = new_dem();
    const TemporaryFolder own_folder;
    CoupledRun run(scene, {&own_fluid, &own_dem, true, true}, own_folder.path(), 1, timers);
    run.start({});
    run.march();
    std::vector<double> cut_at{own_fluid.asked[0].interfaces[0].centre[1]};
    for (const proto::FluidAdvance& asked : own_fluid.asked) {
      const double place = asked.interfaces[0].centre[1];
      if (place == cut_at.back()) continue;
      EXPECT_GT(std::abs(place - cut_at.back()), hold_below * h);
      cut_at.push_back(place);
    }
    return cut_at.size();
  };
  EXPECT_EQ(places(0), 12u);
  EXPECT_EQ(places(1e3), 1u);
  EXPECT_GT(places(1), 1u);
  EXPECT_LT(places(1), 11u);
}

TEST_F(RunTest, the_smallest_step_is_taken_whatever_its_error) {
  scene::Scene scene = make_scene({disc("post", "fixed")});
  scene.time.relative_tolerance = 1e-3;
  scene.time.min_step = 0.05;
  fluid.stiffness = 1e6;
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_EQ(fluid.restores, 1u);
  EXPECT_EQ(fluid.accepts, 24u);
}

TEST_F(RunTest, a_dry_scene_falls_freely_without_loads) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.fluid.reset();
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_EQ(dem.asked.size(), 12u);
  EXPECT_TRUE(dem.asked[0].loads.empty());
  EXPECT_NEAR(run.problem().state().motions[0].position.y(), 3 + 0.5 * gravity * 1.44, 1e-12);
  EXPECT_FALSE(std::filesystem::exists(folder / "fields.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "interface.h5"));
}

TEST_F(RunTest, a_scene_without_bodies_is_the_fluid_alone) {
  const scene::Scene scene = make_scene({});
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_EQ(fluid.asked.size(), 12u);
  EXPECT_TRUE(fluid.asked[0].interfaces.empty());
  EXPECT_TRUE(std::filesystem::exists(folder / "fields.h5"));
}

TEST_F(RunTest, a_steady_scene_is_one_advance_without_a_time_step) {
  scene::Scene scene = make_scene({disc("post", "fixed")});
  scene.time = {.steady = true};
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  ASSERT_EQ(fluid.asked.size(), 1u);
  EXPECT_EQ(fluid.asked[0].time_step, 0);
  EXPECT_EQ(fluid.accepts, 1u);
  EXPECT_EQ(history_lines(), 1u);
}

TEST_F(RunTest, steps_that_do_not_converge_are_restored_and_halved_and_the_end_is_hit) {
  const scene::Scene scene = make_scene({disc("ball", "free")});
  fluid.largest_step = 0.03;
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_EQ(run.progress().time, 1.2);
  EXPECT_GT(run.statistics().steps(), 40u);
  EXPECT_GT(fluid.restores, 1u);
  EXPECT_EQ(fluid.restores, dem.restores);
  EXPECT_EQ(fluid.accepts, run.statistics().steps());
  for (const auto& message : fluid.asked) EXPECT_GT(message.time_step, 0.01);
}

TEST_F(RunTest, after_all_halvings_the_run_ends_with_the_reason_and_its_results) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.time.max_halvings = 2;
  CoupledRun run = make_run(scene);
  run.start({});
  run.on_progress = [this](const RunProgress& s) {
    if (s.step == 4) fluid.largest_step = 1e-9;
  };
  try {
    run.march();
    FAIL() << "it went on";
  } catch (const Error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("step 5"), std::string::npos) << text;
    EXPECT_NE(text.find("the step is too large"), std::string::npos) << text;
  }
  EXPECT_EQ(fluid.restores, 3u);
  EXPECT_EQ(history_lines(), 4u);
  const output::H5File fields = output::H5File::read(folder / "fields.h5");
  EXPECT_EQ(fields.list("/steps").size(), 2u);  // after the first step, and the last accepted state
  EXPECT_DOUBLE_EQ(fields.attribute("/steps/000001", "time"), 0.4);
}

TEST_F(RunTest, a_body_where_the_mesh_is_coarser_than_asked_is_warned_of_once) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  const auto warnings = [&](double elements_per_diameter, const std::string& name) {
    scene.fluid->mesh.elements_per_diameter = elements_per_diameter;
    log::open("coupler", folder / name, log::Level::error);
    CoupledRun run = make_run(scene);
    run.start({});
    run.march();
    log::flush();
    const std::string text = read_text_file(folder / name), told = "its diameter spans 5 triangles only";
    const std::size_t first = text.find(told);
    return first == std::string::npos ? 0 : text.find(told, first + 1) == std::string::npos ? 1 : 2;
  };
  fluid.arc_length = 0.2 * scene.fluid->embedding.arc_ratio;  // of a disc of diameter 1
  EXPECT_EQ(warnings(5, "as_asked"), 0);
  EXPECT_EQ(warnings(16, "too_coarse"), 1);
}

TEST_F(RunTest, a_step_that_is_changed_to_hit_output_times_is_logged) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  const auto logged = [&](const std::string& name) {
    log::open("coupler", folder / name, log::Level::error);
    CoupledRun run = make_run(scene);
    run.start({});
    log::flush();
    return read_text_file(folder / name);
  };
  EXPECT_EQ(logged("fits").find("time.step"), std::string::npos);
  scene.output.interval = 0.24;
  EXPECT_NE(logged("changed").find("is 0.08 s instead of 0.1 s"), std::string::npos);
}

TEST_F(RunTest, an_answer_that_does_not_fit_is_an_error_that_says_so) {
  const scene::Scene scene = make_scene({disc("ball", "free")});
  fluid.missing_tractions = 1;
  CoupledRun run = make_run(scene);
  run.start({});
  EXPECT_THROW(run.march(), Error);
}

TEST_F(RunTest, an_arc_length_that_is_not_positive_is_an_error) {
  const scene::Scene scene = make_scene({disc("ball", "free")});
  fluid.arc_length = 0;
  CoupledRun run = make_run(scene);
  EXPECT_THROW(run.start({}), Error);
}

TEST_F(RunTest, errors_among_the_findings_of_the_fluid_end_the_run_before_its_first_step_with_all_of_them) {
  fluid.findings = {{true, "probes.0", "the probe is outside"},
                    {false, "probes.1", "the probe is doubtful"},
                    {true, "bodies.0", "the body is outside"}};
  const scene::Scene scene = make_scene({disc("a", "free")});
  CoupledRun run = make_run(scene);
  try {
    run.start({});
    FAIL() << "it started";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "the probe is outside\nthe body is outside");
  }
  EXPECT_TRUE(fluid.asked.empty());
}

TEST_F(RunTest, a_rehearsal_sends_the_first_message_of_a_run_and_nothing_else) {
  const scene::Scene scene = make_scene({disc("a", "free"), disc("b", "prescribed")});
  CoupledProblem rehearsed(scene, {&fluid, &dem}, 1);
  rehearsed.configure({}, {});
  rehearsed.rehearse(0.1, 0.1);
  ASSERT_EQ(fluid.asked.size(), 1u);
  proto::FluidAdvance asked = fluid.asked[0];
  EXPECT_TRUE(asked.rehearsal);
  FakeFluid other;
  FakeDem grains = new_dem({{0, 3, 0}, {1, 3, 0}});
  CoupledProblem taken(scene, {&other, &grains}, 1);
  taken.configure({}, {});
  taken.attempt(0, 0.1, 0.1);
  EXPECT_EQ(asked.interfaces, other.asked.at(0).interfaces);
  EXPECT_EQ(asked.time, other.asked[0].time);
  EXPECT_FALSE(other.asked[0].rehearsal);
}

TEST(Statistics, means_leave_out_the_first_five_steps) {
  Statistics statistics;
  const auto add = [&statistics](std::uint32_t sub_iterations) {
    Attempt attempt;
    attempt.sub_iterations = sub_iterations;
    attempt.worst = sub_iterations == 10 ? 4 : 1;
    statistics.add_step(attempt);
  };
  for (int k = 0; k < 5; ++k) add(10);
  EXPECT_EQ(statistics.mean_sub_iterations(), 10);
  add(2);
  add(3);
  EXPECT_EQ(statistics.mean_sub_iterations(), 2.5);
  EXPECT_EQ(statistics.max_sub_iterations(), 10u);
  EXPECT_EQ(statistics.worst()->unknown, 4);
  EXPECT_EQ(statistics.worst()->steps, 5u);
  Statistics other;
  other.set_numbers(statistics.numbers());
  EXPECT_EQ(other.numbers(), statistics.numbers());
  EXPECT_EQ(other.mean_sub_iterations(), 2.5);
}

TEST(Plan, names_the_participants_that_the_scene_needs) {
  scene::Scene scene = make_scene({disc("post", "fixed")});
  scene.fluid->launch.command = "toy";
  EXPECT_EQ(make_plan({scene, {}}, {}).participants.size(), 1u);
  scene.bodies[0].motion = "free";
  scene.dem.emplace();
  scene.dem->launch.external = true;
  const Plan plan = make_plan({scene, {}}, {});
  ASSERT_EQ(plan.participants.size(), 2u);
  EXPECT_EQ(plan.participants[0].command, "toy");
  EXPECT_EQ(plan.participants[1].role, "dem");
  EXPECT_TRUE(plan.participants[1].external);
  scene.fluid.reset();
  EXPECT_EQ(make_plan({scene, {}}, {}).participants.size(), 1u);
}

}  // namespace
}  // namespace fpi
