/// The DEM as a participant: in process, and as the program that a host talks to.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include "../temporary_folder.hpp"
#include "core/error.hpp"
#include "dem_service.hpp"
#include "proto/host.hpp"
#include "proto/token.hpp"

namespace fpi::dem {
namespace {

std::string ball(const std::string& name, const std::string& position) {
  return "[[bodies]]\nname = \"" + name + "\"\nradius = 0.01\ndensity = 2500\nposition = " + position + "\n";
}

std::string wall(const std::string& name, const std::string& point, const std::string& normal) {
  return "[[walls]]\nname = \"" + name + "\"\npoint = " + point + "\nnormal = " + normal + "\n";
}

const std::string scene = R"(
gravity = [0, -9.81]
[time]
step = 1e-3
end = 1
)" + ball("a", "[0, 0.5]") +
                          R"(
[[bodies]]
name = "post"
radius = 0.01
motion = "fixed"
position = [1, 0.5]
[[materials]]
name = "stone"
youngs_modulus = 1e8
)" + wall("floor", "[0, 0]", "[0, 1]");

proto::DemAdvance fall(double time_step) {
  return {.time = time_step,
          .time_step = time_step,
          .loads = {},
          .prescribed = {{.body = 1, .position = {1, 0.5, 0}}}};
}

TEST(DemService, moves_the_bodies_of_the_scene_it_is_sent) {
  DemService service;
  EXPECT_EQ(service.configure({.scene = scene}).figures.at(0).second, 2);
  const proto::DemAdvanced moved = service.advance({}, fall(0.1));
  ASSERT_TRUE(moved.converged);
  ASSERT_EQ(moved.motions.size(), 2u);
  EXPECT_NEAR(moved.motions[0].position[1], 0.5 - 0.5 * 9.81 * 0.01, 1e-15);
  EXPECT_EQ(moved.motions[1].position, (proto::Vec3{1, 0.5, 0}));
  EXPECT_EQ(moved.motions[0].orientation, (std::array<double, 4>{1, 0, 0, 0}));
  EXPECT_EQ(moved.sub_steps, 1u);
}

std::vector<std::string> keys_of_errors(const std::string& text) {
  std::vector<std::string> keys;
  for (const Finding& finding : DemService().configure({.scene = text}).findings)
    if (finding.is_error) keys.push_back(finding.key);
  return keys;
}

TEST(DemService, finds_every_wall_and_every_overlap_that_is_wrong_and_says_where) {
  EXPECT_EQ(keys_of_errors(scene + wall("ramp", "[0, 0]", "[0.1, 1]") + wall("lid", "[0, 2]", "[0.1, -1]") +
                           "[periodic]\nx = [-2, 2]\n"),
            (std::vector<std::string>{"walls.1", "walls.2"}));
  EXPECT_EQ(keys_of_errors(scene + ball("deeper", "[3, 0.002]") + ball("in_the_floor", "[2, 0.005]")),
            (std::vector<std::string>{"bodies.2.position", "bodies.3.position"}));
}

TEST(DemService, restores_and_resumes_bitwise) {
  DemService service, resumed;
  service.configure({.scene = scene});
  service.advance({}, fall(0.1));
  service.accept({});
  const proto::Bytes state = service.checkpoint().bytes;
  const proto::DemAdvanced first = service.advance({}, fall(0.3));
  service.restore();
  resumed.configure({.scene = scene, .state = state});
  for (DemService* other : {&service, &resumed}) {
    const proto::DemAdvanced again = other->advance({}, fall(0.3));
    EXPECT_EQ(again.motions[0].position, first.motions[0].position);
    EXPECT_EQ(again.motions[0].velocity, first.motions[0].velocity);
  }
}

TEST(DemService, reports_its_time_and_counts) {
  DemService service;
  service.configure({.scene = scene});
  service.advance({}, fall(0.1));
  const proto::Figures figures = service.report();
  ASSERT_EQ(figures.size(), 3u);
  EXPECT_EQ(figures[2].first, "seconds:dem");
  EXPECT_GT(figures[2].second, 0);
}

TEST(DemService, ends_the_run_when_an_accepted_step_has_lost_a_body) {
  DemService service;
  service.configure({.scene = scene + "[dem]\nlost_distance = 0.5\n"});
  service.advance({}, fall(1));  // beyond the floor or not, it is tried only
  service.restore();
  service.advance({}, fall(0.1));
  EXPECT_NO_THROW(service.accept({}));
  proto::DemAdvance up = fall(0.9);
  up.loads = {{.body = 0, .force = {0, 1000, 0}}};
  service.advance({}, up);
  try {
    service.accept({});
    FAIL() << "it is 500 m up";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("a is lost"), std::string::npos) << e.what();
  }
}

TEST(DemService, says_that_contacts_are_stretched) {
  DemService service;
  EXPECT_EQ(service.configure({.scene = scene + "[dem]\nstretch = 4\n"}).notes.at(0),
            "contacts last 4 times as long as the materials say");
  EXPECT_EQ(service.report().back(), (proto::Figures::value_type{"stretch", 4}));
}

TEST(DemService, refuses_a_step_longer_than_the_scene_which_could_take_for_ever) {
  DemService service;
  service.configure({.scene = scene});
  EXPECT_THROW(service.advance({}, fall(1e6)), Error);
  EXPECT_TRUE(service.advance({}, fall(0.1)).converged);
}

TEST(DemService, refuses_what_it_cannot_do) {
  DemService service;
  EXPECT_THROW(service.advance({}, fall(0.1)), Error);
  EXPECT_THROW(service.configure({.scene = "[[bodies]]\nname = 3"}), Error);
  EXPECT_THROW(
      service.configure({.scene = scene + "[[bodies]]\nname = \"a\"\nradius = 1\nposition = [9, 9]"}), Error);
  EXPECT_THROW(service.configure({.scene = scene, .state = {1, 2, 3}}), Error);
}

/// dem_server, started with `address`.
class Process {
 public:
  Process(std::string address, std::string token_file) {
    std::string program = DEM_SERVER, connect = "--connect", token = "--token";
    char* arguments[] = {program.data(), connect.data(),    address.data(),
                         token.data(),   token_file.data(), nullptr};
    if (posix_spawn(&id_, DEM_SERVER, nullptr, nullptr, arguments, environ) != 0)
      fail("cannot start {}", DEM_SERVER);
  }
  int exit_status() {
    int status = -1;
    waitpid(id_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t id_ = 0;
};

TEST(DemServer, serves_a_host_until_goodbye) {
  proto::HostOptions options;
  options.run = 7;
  const TemporaryFolder folder;
  const proto::TokenFile token(folder.path());
  options.token = token.token();
  proto::Host host(options);
  Process process(host.address(), token.path());
  const std::vector<proto::Hello> hellos = host.admit({"dem"}, {false});
  EXPECT_EQ(hellos.at(0).capabilities,
            (std::vector<std::string>{"checkpoint", "added_inertia", "resistance"}));
  const auto ask = [&]<class Answer>(proto::Message message) {
    return host.ask<Answer>("dem", {.run = 7, .step = 1, .sub_iteration = 0}, std::move(message));
  };
  ask.operator()<proto::Configured>(proto::Configure{.scene = scene});
  const auto moved = ask.operator()<proto::DemAdvanced>(fall(0.1));
  EXPECT_NEAR(moved.motions.at(0).velocity[1], -0.981, 1e-15);
  ask.operator()<proto::Accepted>(proto::Accept{});
  EXPECT_FALSE(ask.operator()<proto::State>(proto::Checkpoint{}).bytes.empty());
  const auto figures = host.dismiss("done");
  EXPECT_EQ(figures.at(0).first, "dem");
  EXPECT_EQ(process.exit_status(), 0);
}

}  // namespace
}  // namespace fpi::dem
