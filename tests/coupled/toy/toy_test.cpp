/// The toy fluid in place of fluid_server: a program of its own, in a folder of its own, over loopback with
/// CURVE.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "../../unit/temporary_folder.hpp"
#include "proto/host.hpp"
#include "proto/keys.hpp"

namespace fpi::proto {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

constexpr double mu = 0.5, density = 1000, thickness = 0.2, gravity = -9.81, a = 0.01, b = 0.05;

const char* const scene = R"(
title = "a disc in a viscous fluid"
gravity = [0.0, -9.81]
thickness = 0.2
[time]
step = 0.01
end = 1.0
[fluid]
density = 1000.0
dynamic_viscosity = 0.5
mesh = {lower = [0.0, 0.0], upper = [0.1, 0.4], cells_x = 10, cells_y = 40}
boundaries = {left = {type = "slip"}, right = {type = "slip"}, bottom = {type = "slip"}, top = {type = "slip"}}
[[bodies]]
name = "disc"
radius = 0.01
density = 1100.0
position = [0.05, 0.3]
)";

/// A coupler here, and the toy as a process elsewhere with nothing but its keys.
class Toy : public testing::Test {
 protected:
  Toy() {
    make_keys(coupler_ / "keys");
    for (const char* file : {"participant.secret", "participant.public", "coupler.public"})
      fs::copy(fs::path(coupler_ / "keys") / file, toy_ / file);
    HostOptions options;
    options.keys = coupler_ / "keys";
    host_ = std::make_unique<Host>(options);
    const std::string address = host_->address();
    child_ = fork();
    if (child_ == 0) {
      if (chdir(toy_.path().c_str()) == 0)
        execl(TOY_STOKES_FLUID, "toy_stokes_fluid", "--connect", address.c_str(), "--keys", ".", "--log",
              "toy.log", nullptr);
      _exit(127);
    }
    host_->admit({"fluid"}, {false});
    configured_ = host_->ask<Configured>("fluid", {}, Configure{.scene = scene});
  }
  ~Toy() override {
    host_->dismiss("the test is over");
    int status = -1;
    EXPECT_EQ(waitpid(child_, &status, 0), child_);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << read_text_file(toy_ / "toy.log");
  }
  Traction answer(const Interface& disc) {
    const auto advanced = host_->ask<FluidAdvanced>("fluid", {0, 1, 0}, FluidAdvance{0.01, 0.01, {disc}});
    EXPECT_TRUE(advanced.converged);
    return advanced.tractions.at(0);
  }

  TemporaryFolder coupler_, toy_;
  std::unique_ptr<Host> host_;
  pid_t child_ = -1;
  Configured configured_;
};

Interface moving_disc() {
  return {.centre = {0.05, 0.3, 0},
          .radius = a,
          .start = {0, 1, 3},
          .end = {1, 3, 2 * pi},
          .translation = {0.02, -0.03, 0},
          .spin = {0, 0, 1.5}};
}

TEST_F(Toy, wants_arcs_that_divide_the_circle) {
  ASSERT_EQ(configured_.arc_lengths.size(), 1u);
  EXPECT_NEAR(configured_.arc_lengths[0].length, 2 * pi * a / 32, 1e-15);
}

TEST_F(Toy, gives_the_drag_of_concentric_cylinders_and_the_buoyancy) {
  const Traction traction = answer(moving_disc());
  // b/a = 5: ln 5 − 24/26.
  const double drag = 4 * pi * mu * thickness / (std::log(5.0) - 24.0 / 26.0);
  EXPECT_NEAR(traction.force[0], -drag * 0.02, 1e-12 * drag);
  EXPECT_NEAR(traction.force[1], drag * 0.03 - density * gravity * pi * a * a * thickness, 1e-12 * drag);
  EXPECT_NEAR(traction.torque[2], -4 * pi * mu * thickness * 1.5 * a * a * b * b / (b * b - a * a), 1e-15);
}

TEST_F(Toy, still_fluid_carries_the_buoyancy_only) {
  Interface disc = moving_disc();
  disc.translation = disc.spin = {};
  const Traction traction = answer(disc);
  EXPECT_EQ(traction.force[0], 0);
  EXPECT_NEAR(traction.force[1], density * 9.81 * pi * a * a * thickness, 1e-12);
  for (const double value : traction.values) EXPECT_EQ(value, 0);
}

TEST_F(Toy, tractions_add_up_to_force_and_torque) {
  const Interface disc = moving_disc();
  const Traction traction = answer(disc);
  ASSERT_EQ(traction.values.size(), 2 * disc.size());
  double fx = 0, fy = 0, torque = 0;
  for (std::size_t arc = 0; arc < disc.size(); ++arc) {
    const double s = disc.start[arc], e = disc.end[arc];
    const double lx = traction.values[2 * arc], ly = traction.values[2 * arc + 1];
    fx += lx * a * (e - s) * thickness;
    fy += ly * a * (e - s) * thickness;
    // ∫ (cos θ λy − sin θ λx) a² dθ
    torque += a * a * thickness * (ly * (std::sin(e) - std::sin(s)) + lx * (std::cos(e) - std::cos(s)));
  }
  const double buoyancy = -density * gravity * pi * a * a * thickness;
  EXPECT_NEAR(fx, traction.force[0], 1e-14);
  EXPECT_NEAR(fy, traction.force[1] - buoyancy, 1e-14);
  EXPECT_NEAR(torque, traction.torque[2], 1e-15);
}

}  // namespace
}  // namespace fpi::proto
