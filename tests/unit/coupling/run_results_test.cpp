/// What a run leaves: fields, history, figures, checkpoints.
#include "run_case.hpp"

namespace fpi {
namespace {

TEST_F(RunTest, fields_are_written_after_the_first_step_at_each_interval_and_at_the_end) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.output.interval = 0.5;
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  for (const char* name : {"fields.h5", "interface.h5"}) {
    const output::H5File file = output::H5File::read(folder / name);
    std::vector<double> times;
    for (const std::string& step : file.list("/steps"))
      times.push_back(file.attribute("/steps/" + step, "time"));
    ASSERT_EQ(times.size(), 4u) << name;
    EXPECT_EQ((std::vector<double>(times.begin() + 1, times.end())), (std::vector<double>{0.5, 1, 1.2}))
        << name;
  }
}

TEST_F(RunTest, without_fields_asked_for_none_are_gathered) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.output.fields = false;
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_FALSE(std::filesystem::exists(folder / "fields.h5"));
  EXPECT_EQ(history_lines(), 12u);
}

TEST_F(RunTest, a_fluid_without_fields_still_has_its_tractions_written) {
  fluid.has_fields = false;
  const scene::Scene scene = make_scene({disc("ball", "free")});
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_FALSE(std::filesystem::exists(folder / "fields.h5"));
  EXPECT_EQ(output::H5File::read(folder / "interface.h5").list("/steps").size(), 2u);
}

TEST_F(RunTest, resumed_at_its_checkpoint_a_run_ends_in_the_same_bits) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.output.interval = 0.3;
  scene.output.checkpoint_every = 5;
  fluid.largest_step = 0.06;  // with halved and regrown steps on both sides of the checkpoint
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const std::string history = read_text_file(folder / "history.csv");
  const std::string xdmf = read_text_file(folder / "fields.xdmf");
  const std::vector<double> position = output::H5File::read(folder / "bodies.h5").doubles("/position");

  FakeFluid new_fluid;
  new_fluid.largest_step = fluid.largest_step;
  FakeDem other_dem = new_dem();
  CoupledRun again(scene, {&new_fluid, &other_dem}, folder.path(), 2, timers);
  again.resume({}, last_checkpoint_before_the_end(scene));
  EXPECT_LT(history_lines(), run.statistics().steps());
  again.march();
  EXPECT_LT(new_fluid.accepts, fluid.accepts);
  EXPECT_EQ(read_text_file(folder / "history.csv"), history);
  EXPECT_EQ(read_text_file(folder / "fields.xdmf"), xdmf);
  EXPECT_EQ(output::H5File::read(folder / "bodies.h5").doubles("/position"), position);
  EXPECT_EQ(again.statistics().steps(), run.statistics().steps());
  EXPECT_EQ(again.statistics().mean_sub_iterations(), run.statistics().mean_sub_iterations());
}

TEST_F(RunTest, a_resumed_run_that_takes_no_step_writes_no_fields) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.output.checkpoint_every = 5;
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const Checkpoint checkpoint = last_checkpoint_before_the_end(scene);
  fluid.largest_step = 0;
  CoupledRun again = make_run(scene);
  again.resume({}, checkpoint);
  EXPECT_THROW(again.march(), Error);
  for (const char* name : {"fields.h5", "interface.h5"})
    EXPECT_EQ(output::H5File::read(folder / name).list("/steps").size(), 1u) << name << ": the first step's";
}

TEST_F(RunTest, a_checkpoint_of_another_scene_is_refused_but_one_that_only_ends_earlier_is_taken) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_NO_THROW(newest_checkpoint(scene));
  scene.time.end = 2;
  EXPECT_NO_THROW(newest_checkpoint(scene));
  scene.fluid->density = 2;
  EXPECT_THROW(newest_checkpoint(scene), Error);
}

/// Runs the scene with participants of its own, from a checkpoint or from the start.
void run_to_end(RunTest& test, const scene::Scene& scene, const std::optional<Checkpoint>& checkpoint = {}) {
  FakeFluid fluid;
  FakeDem dem = RunTest::new_dem();
  CoupledRun run(scene, {&fluid, &dem}, test.folder.path(), 1, test.timers);
  checkpoint ? run.resume({}, *checkpoint) : run.start({});
  run.march();
}

TEST_F(RunTest, a_finished_run_that_is_extended_is_the_longer_run_to_the_bit) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.output.checkpoint_every = 4;
  scene.output.interval = 0.6;
  scene::Scene longer = scene;
  longer.time.end = 2 * scene.time.end;
  run_to_end(*this, longer);
  const std::string history = read_text_file(folder / "history.csv"),
                    xdmf = read_text_file(folder / "fields.xdmf");
  run_to_end(*this, scene);
  EXPECT_EQ(history_lines(), 12u);
  run_to_end(*this, longer, newest_checkpoint(longer));
  EXPECT_EQ(read_text_file(folder / "history.csv"), history);
  EXPECT_EQ(read_text_file(folder / "fields.xdmf"), xdmf);
}

TEST_F(RunTest, a_run_that_fails_leaves_the_last_state_that_it_can_be_resumed_from) {
  scene::Scene scene = make_scene({disc("ball", "free")});  // a checkpoint by wall time is not due yet
  scene.time.end = 6;
  CoupledRun run = make_run(scene);
  run.start({});
  run.on_progress = [&](const RunProgress& standing) {
    if (standing.step == 30) fail("stopped");
  };
  EXPECT_THROW(run.march(), Error);
  EXPECT_EQ(newest_checkpoint(scene).problem.at("steps").front(), 25);
  const output::H5File bodies = output::H5File::read(folder / "bodies.h5");
  EXPECT_EQ(bodies.shape("/position")[0], 30u) << "all rows are in the file";
}

TEST_F(RunTest, without_checkpoints_asked_for_none_are_written) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.output.checkpoint_interval = 0;
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_FALSE(has_checkpoint(folder.path()));
}

TEST_F(RunTest, when_a_checkpoint_is_written_changes_no_bit) {
  scene::Scene scene = make_scene({disc("ball", "free")});
  scene.time.end = 6;
  std::vector<std::string> histories;
  for (const double interval : {1e-9, 1e9}) {  // at each state that can be resumed, at none
    scene.output.checkpoint_interval = interval;
    run_to_end(*this, scene);
    histories.push_back(read_text_file(folder / "history.csv"));
  }
  EXPECT_EQ(histories[0], histories[1]);
}

TEST_F(RunTest, drag_lift_and_probes_are_reported_of_boundaries_and_bodies) {
  scene::Scene scene = make_scene({disc("post", "fixed")});
  scene.thickness = 0.5;
  scene.coefficients = {{.name = "", .on = "left", .velocity = 2, .length = 0.25}};
  scene.probes = {{.name = "p", .point = {0, 0}, .minus = {}}};
  const auto lift = [&] {
    CoupledRun run = make_run(scene);
    run.start({});
    run.march();
    EXPECT_EQ(run.last_reported().probes, std::vector{static_cast<double>(fluid.accepts)});
    return run.last_reported().coefficients.at(0).lift;
  };
  EXPECT_DOUBLE_EQ(lift(), 2 * 6 / (1 * 4 * 0.25 * 0.5));
  scene.coefficients[0].on = "post";
  EXPECT_DOUBLE_EQ(lift(), 2 * 0.5 / (1 * 4 * 0.25 * 0.5));
}

TEST_F(RunTest, loads_of_boundaries_that_hold_the_fluid_are_columns_of_the_history) {
  scene::Scene scene = make_scene({});
  scene.fluid->boundaries["left"].type = "no_slip";
  scene.fluid->boundaries["right"].type = "traction";
  scene.fluid->boundaries["top"].type = "slip";
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const output::Columns history = output::read_columns(folder / "history.csv");
  EXPECT_EQ(history.at("left.fx").back(), 4);
  EXPECT_EQ(history.at("left.fy").back(), 6);
  EXPECT_TRUE(std::isnan(history.at("top.torque").back())) << "the fluid did not say";
  EXPECT_FALSE(history.contains("right.fx"));
}

TEST_F(RunTest, several_coefficients_have_columns_of_their_own_and_extrema_over_the_second_half) {
  scene::Scene scene = make_scene({disc("post", "fixed")});
  scene.coefficients = {{.name = "wall", .on = "left", .velocity = 1, .length = 1},
                        {.name = "post", .on = "post", .velocity = 1, .length = 1}};
  scene.probes = {{.name = "p", .point = {0, 0}, .minus = {}}};
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  const output::Columns history = output::read_columns(folder / "history.csv");
  EXPECT_EQ(history.at("wall.lift").back(), 12);
  EXPECT_EQ(history.at("post.lift").back(), 1);
  const MeasuredSignals signals = measure_signals(scene, folder.path());
  EXPECT_EQ(signals.size(), 5u);
  EXPECT_EQ(signals.at("p").figures.smallest.value, 6) << "12 steps, p counts them";
  EXPECT_EQ(signals.at("p").figures.largest.value, 12);
  EXPECT_FALSE(signals.at("wall.lift").strouhal) << "it does not oscillate";
  write_extrema(signals, folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder / "extrema.csv"));
}

TEST_F(RunTest, a_probe_without_a_value_is_written_as_nan_and_the_run_goes_on) {
  scene::Scene scene = make_scene({});
  scene.probes = {{.name = "q", .point = {0, 0}, .minus = {}}};
  CoupledRun run = make_run(scene);
  run.start({});
  run.march();
  EXPECT_TRUE(std::isnan(run.last_reported().probes.at(0)));
}

TEST_F(RunTest, a_boundary_force_that_the_fluid_does_not_report_is_an_error_that_names_it) {
  scene::Scene scene = make_scene({});
  scene.coefficients = {{.name = "", .on = "wall", .velocity = 1, .length = 1}};
  CoupledRun run = make_run(scene);
  run.start({});
  try {
    run.march();
    FAIL() << "it went on";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("\"force_x:wall\""), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace fpi
