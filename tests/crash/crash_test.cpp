/// A run is killed at a write to the disk, any of them: what it left can be read and goes on to the same
/// bits.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "../unit/coupling/run_case.hpp"
#include "kill_at_write.hpp"
#include "run/run_folder.hpp"

namespace fpi {
namespace {

/// What a killed process wrote is there without the disk: in memory hundreds of runs take seconds.
[[maybe_unused]] const bool is_in_memory =
    std::filesystem::is_directory("/dev/shm") && setenv("TMPDIR", "/dev/shm", 1) == 0;

/// What the files of a run hold: of HDF5 the arrays, since the same arrays may lie differently in a file.
std::map<std::string, std::vector<double>> content_of(const std::string& folder) {
  std::map<std::string, std::vector<double>> content;
  const output::H5File bodies = output::H5File::read(folder + "/bodies.h5");
  for (const char* name : {"/time", "/position", "/rotation", "/velocity", "/spin", "/force", "/torque"})
    if (bodies.has(name)) content[name] = bodies.doubles(name);
  for (const std::string name : {"fields", "interface"}) {
    const std::string path = folder + "/" + name + ".h5";
    if (!std::filesystem::exists(path)) continue;
    const output::H5File file = output::H5File::read(path);
    if (!file.has("/steps")) continue;
    for (const std::string& step : file.list("/steps")) {
      const std::string group = "/steps/" + step;
      content[name + group] = {file.attribute(group, "time")};
      for (const std::string& array : file.list(group))
        content[name + group + "/" + array] = file.doubles(group + "/" + array);
    }
  }
  for (const auto& [column, values] : output::read_columns(folder + "/history.csv"))
    content["history " + column] = values;
  return content;
}

class Crash : public RunTest {
 protected:
  Crash() {
    scene_.output.interval = 0.3;
    scene_.output.checkpoint_every = 3;
  }

  void begin_or_resume(const std::string& in) {
    FakeFluid new_fluid;
    FakeDem other_dem = new_dem();
    CoupledRun run(scene_, {&new_fluid, &other_dem}, in, 1, timers);
    if (has_checkpoint(in)) {
      run.resume({}, read_checkpoint(in, inputs_up_to_any_end(scene_, {})));
    } else {
      clear_folder(in);
      run.start({});
    }
    run.march();
  }

  /// Whether a run in the folder was killed at its n-th write.
  bool kill_run(const std::string& in, long n) {
    const pid_t child = fork();
    if (child == 0) {
      kill_at_write(n);
      begin_or_resume(in);
      _exit(0);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  }

  /// All that there is of each array lies within what the whole run has: whole steps, and as many rows in
  /// each column.
  void expect_readable(const std::string& in) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(in)) {
      if (entry.path().extension() == ".h5") {
        EXPECT_NO_THROW(output::H5File::read(entry.path())) << entry.path();
      }
    }
    if (!std::filesystem::exists(in + "/bodies.h5") || !std::filesystem::exists(in + "/history.csv")) return;
    if (read_text_file(in + "/history.csv").find('\n') == std::string::npos) return;
    const auto left = content_of(in);
    const std::size_t rows = left.contains("/time") ? left.at("/time").size() : 0;
    for (const auto& [name, values] : left) {
      const std::vector<double>& all = whole_.at(name);
      const bool is_of_bodies = name.starts_with("/"),
                 is_column = is_of_bodies || name.starts_with("history ");
      const std::size_t size = is_of_bodies ? rows * all.size() / whole_.at("/time").size() : all.size();
      EXPECT_TRUE(values.size() == size || name.starts_with("history ")) << name;
      EXPECT_TRUE(is_column || values == all) << name;
      EXPECT_TRUE(std::equal(values.begin(), values.end(), all.begin(), [](double a, double b) {
        return a == b || (std::isnan(a) && std::isnan(b));
      })) << name;
    }
  }

  void expect_whole(const std::string& in) {
    const auto found = content_of(in);
    EXPECT_EQ(found.size(), whole_.size());
    EXPECT_EQ(read_text_file(in + "/history.csv"), read_text_file(folder / "whole/history.csv"));
    EXPECT_EQ(read_text_file(in + "/fields.xdmf"), read_text_file(folder / "whole/fields.xdmf"));
    expect_readable(in);
  }

  scene::Scene scene_ = make_scene({disc("ball", "free")});
  std::map<std::string, std::vector<double>> whole_;
};

TEST_F(Crash, a_hundred_kills_at_a_write_leave_files_that_can_be_read_and_go_on_to_the_same_bits) {
  make_folder(folder / "whole");
  kill_at_write(0);
  begin_or_resume(folder / "whole");
  const long writes = writes_so_far();
  whole_ = content_of(folder / "whole");
  ASSERT_GT(writes, 100);
  for (long kill = 0; kill < 100; ++kill) {
    const std::string in = folder / fmt::format("{}", kill);
    make_folder(in);
    SCOPED_TRACE(fmt::format("killed at write {} of {}", 1 + kill * writes / 100, writes));
    ASSERT_TRUE(kill_run(in, 1 + kill * writes / 100));
    expect_readable(in);
    // what goes on is killed, too
    if (kill % 3 == 0 && kill_run(in, 1 + 7 * kill % 40)) expect_readable(in);
    kill_at_write(0);
    begin_or_resume(in);
    expect_whole(in);
    std::filesystem::remove_all(in);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace fpi
