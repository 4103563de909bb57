/// Asking, answering, and what happens when one side goes away or misbehaves.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "../temporary_folder.hpp"
#include "parties.hpp"
#include "samples.hpp"

namespace fpi::proto {
namespace {

using namespace parties;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

HostOptions options() {
  HostOptions o = with_token();
  o.run = 77;
  o.silence_timeout = 1;
  o.heartbeat_interval = 0.1;
  o.join_timeout = 5;
  return o;
}

/// A run with a fluid in a thread, configured.
struct FluidRun {
  explicit FluidRun(const HostOptions& o = options())
      : host(o), status(serve_in_thread(fluid, connection_to(host.address()))) {
    host.admit({"fluid"}, {false});
    host.ask<Configured>("fluid", {}, Configure{.scene = "a scene"});
  }
  ~FluidRun() { host.dismiss("the test is over"); }
  FluidAdvanced advance(std::uint64_t step) {
    return host.ask<FluidAdvanced>("fluid", {77, step, 2}, FluidAdvance{});
  }
  /// What the coupler says of a fluid that it lost in step 12.
  std::string loss() {
    try {
      advance(12);
    } catch (const ParticipantLost& e) {
      return e.what();
    }
    return "nothing was lost";
  }
  Fluid fluid;
  Host host;
  std::future<int> status;
};

/// stuck_peer as a process of its own.
class StuckPeer {
 public:
  StuckPeer(const char* side, const std::string& address) : pid_(fork()) {
    if (pid_ != 0) return;
    execl(STUCK_PEER, "stuck_peer", side, address.c_str(), nullptr);
    _exit(127);
  }
  ~StuckPeer() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  void signal(int number) const { kill(pid_, number); }
  /// The exit status, once it has ended by itself within `limit` seconds; -1 where it has not.
  int exit_status(double limit) const {
    for (const auto start = Clock::now(); seconds(start) < limit;
         std::this_thread::sleep_for(milliseconds(20))) {
      siginfo_t info{};
      if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
          info.si_pid == pid_)
        return info.si_code == CLD_EXITED ? info.si_status : -1;
    }
    return -1;
  }

 private:
  pid_t pid_;
};

TEST(Life, every_request_gets_its_answer) {
  FluidRun run;
  run.fluid.on_advance = [](const Stamp& stamp, const FluidAdvance& advance) {
    return FluidAdvanced{.converged = stamp == Stamp{77, 3, 1}, .residual = advance.time};
  };
  const auto answer = run.host.ask<FluidAdvanced>("fluid", {77, 3, 1}, FluidAdvance{.time = 0.25});
  EXPECT_TRUE(answer.converged);
  EXPECT_EQ(answer.residual, 0.25);
  EXPECT_EQ(run.host.ask<Accepted>("fluid", {77, 3, 1}, Accept{}).figures, (Figures{{"accepted", 1}}));
  run.host.ask<Restored>("fluid", {77, 3, 1}, Restore{});
  EXPECT_TRUE(run.host.ask<Fields>("fluid", {77, 3, 1}, Write{}).fields.empty());
  EXPECT_TRUE(run.host.ask<State>("fluid", {77, 3, 1}, Checkpoint{}).bytes.empty());
  const auto figures = run.host.dismiss("done");
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].first, "fluid");
  ASSERT_EQ(figures[0].second.size(), 2u);
  EXPECT_EQ(figures[0].second[0], (std::pair<std::string, double>{"restored", 1}));
  EXPECT_EQ(figures[0].second[1].first, "peak_memory_bytes");
  EXPECT_GT(figures[0].second[1].second, 1e6);
  EXPECT_EQ(run.status.get(), 0);
}

TEST(Life, large_messages_arrive) {
  FluidRun run;
  run.fluid.on_advance = [](auto&, const FluidAdvance& advance) {
    return FluidAdvanced{.tractions = {{.values = advance.interfaces.at(0).velocities, .arc_length = 1}}};
  };
  Interface mesh = samples::arcs();
  mesh.points = 100'000;
  mesh.velocities.assign(400'000, 0.5);
  const auto answer = run.host.ask<FluidAdvanced>("fluid", {77, 1, 0}, FluidAdvance{.interfaces = {mesh}});
  EXPECT_EQ(answer.tractions.at(0).values, mesh.velocities);
  run.host.dismiss("done");
}

TEST(Life, a_busy_participant_is_not_dead) {
  FluidRun run;
  run.fluid.on_advance = [](auto&, auto&) {
    std::this_thread::sleep_for(milliseconds(2000));
    return FluidAdvanced{.converged = true};
  };
  EXPECT_TRUE(run.advance(1).converged);
  run.host.dismiss("done");
}

TEST(Life, a_busy_coupler_is_not_dead) {
  HostOptions o = options();
  o.silence_timeout = 0.5;
  Host host(o);
  Fluid fluid;
  auto status = serve_in_thread(fluid, connection_to(host.address()));
  host.admit({"fluid"}, {false});
  std::this_thread::sleep_for(milliseconds(1500));
  EXPECT_NO_THROW(host.ask<Configured>("fluid", {}, Configure{}));
  host.dismiss("done");
  EXPECT_EQ(status.get(), 0);
}

TEST(Life, an_error_of_the_solver_ends_the_run_with_its_sentence) {
  FluidRun run;
  run.fluid.on_advance = [&](auto&, auto&) -> FluidAdvanced {
    run.fluid.progress.set("newton");
    fail("a pivot must not be 0; got 0 in row 5");
  };
  EXPECT_EQ(run.loss(),
            "fluid (test_program 1.2) reported an error: a pivot must not be 0; got 0 in row 5, in phase "
            "\"newton\" "
            "of step 12, sub-iteration 2");
  EXPECT_EQ(run.status.get(), 1);
}

TEST(Life, an_answer_that_is_not_finite_ends_the_run) {
  FluidRun run;
  run.fluid.on_advance = [](auto&, auto&) { return FluidAdvanced{.residual = std::nan("")}; };
  EXPECT_NE(run.loss().find("FluidAdvanced.residual must be finite; got nan"), std::string::npos);
}

TEST(Life, an_answer_of_another_kind_ends_the_run) {
  FluidRun run;
  try {
    run.host.ask<Fields>("fluid", {77, 1, 0}, Restore{});
    FAIL();
  } catch (const ParticipantLost& e) {
    EXPECT_NE(std::string(e.what()).find("answered Restore with Restored"), std::string::npos) << e.what();
  }
}

TEST(Life, requests_out_of_order_are_refused) {
  Host host(options());
  Fluid fluid;
  auto status = serve_in_thread(fluid, connection_to(host.address()));
  host.admit({"fluid"}, {false});
  EXPECT_THROW(host.ask<FluidAdvanced>("fluid", {77, 1, 0}, FluidAdvance{}), ParticipantLost);
  EXPECT_EQ(status.get(), 1);
}

TEST(Life, what_was_accepted_or_restored_is_not_accepted_again) {
  const auto refusal = [](Message first) {
    FluidRun run;
    run.advance(1);
    try {
      if (std::holds_alternative<Accept>(first))
        run.host.ask<Accepted>("fluid", {77, 1, 2}, first);
      else
        run.host.ask<Restored>("fluid", {77, 1, 2}, first);
      run.host.ask<Accepted>("fluid", {77, 1, 2}, Accept{});
    } catch (const ParticipantLost& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refusal(Accept{}).find("Accept must follow an advance"), std::string::npos);
  EXPECT_NE(refusal(Restore{}).find("Accept must follow an advance"), std::string::npos);
}

/// What the coupler says when a client that has joined as the fluid answers step 12, sub-iteration 2 of run
/// 77 with `stamp`.
std::string loss_by_answer(const Stamp& stamp) {
  Host host(options());
  std::thread fluid([&, address = host.address()] {
    Client client(address);
    client.send(encode({{},
                        Hello{.role = "fluid",
                              .program = "other",
                              .program_version = "9",
                              .schema_fingerprint = schema_fingerprint()}}));
    EXPECT_TRUE(std::holds_alternative<Welcome>(client.receive()));
    EXPECT_TRUE(std::holds_alternative<FluidAdvance>(client.receive()));
    client.send(encode({stamp, FluidAdvanced{.converged = true}}));
    EXPECT_TRUE(std::holds_alternative<Goodbye>(client.receive()));
    client.send(encode({{}, Farewell{}}));
  });
  host.admit({"fluid"}, {false});
  std::string loss;
  try {
    host.ask<FluidAdvanced>("fluid", {77, 12, 2}, FluidAdvance{});
  } catch (const ParticipantLost& e) {
    loss = e.what();
  }
  host.dismiss("the test is over");
  fluid.join();
  return loss;
}

TEST(Life, an_answer_with_a_foreign_stamp_names_its_sender) {
  EXPECT_EQ(loss_by_answer({77, 12, 2}), "");
  for (const Stamp& foreign : {Stamp{78, 12, 2}, Stamp{77, 11, 2}, Stamp{77, 12, 1}})
    EXPECT_EQ(
        loss_by_answer(foreign),
        fmt::format("fluid (other 9) answered FluidAdvance of run 000000000000004d, step 12, sub-iteration 2 "
                    "with FluidAdvanced of run {:016x}, step {}, sub-iteration {}; an answer repeats the "
                    "stamp of its request, in phase \"start\" of step 12, sub-iteration 2",
                    foreign.run, foreign.step, foreign.sub_iteration));
}

TEST(Life, a_coupler_that_stood_still_calls_nobody_lost) {
  HostOptions o = options();
  Host host(o);
  Fluid fluid;
  Dem dem;
  auto fluid_status = serve_in_thread(fluid, connection_to(host.address()));
  auto dem_status = serve_in_thread(dem, connection_to(host.address()));
  host.admit({"fluid", "dem"}, {false, false});
  for (const char* role : {"fluid", "dem"}) host.ask<Configured>(role, {}, Configure{});
  fluid.on_advance = [](auto&, auto&) {
    std::this_thread::sleep_for(milliseconds(2500));
    return FluidAdvanced{.converged = true};
  };
  host.while_waiting = [stood_still = false]() mutable {  // as one that was stopped, or whose machine slept
    if (!std::exchange(stood_still, true)) std::this_thread::sleep_for(milliseconds(1800));
  };
  EXPECT_TRUE(host.ask<FluidAdvanced>("fluid", {77, 1, 0}, FluidAdvance{}).converged);
  host.while_waiting = nullptr;
  EXPECT_TRUE(host.ask<DemAdvanced>("dem", {77, 1, 0}, DemAdvance{}).converged);
  host.dismiss("done");
  EXPECT_EQ(fluid_status.get(), 0);
  EXPECT_EQ(dem_status.get(), 0);
}

TEST(Life, a_killed_participant_ends_the_run_with_its_name_and_phase) {
  Host host(options());
  StuckPeer child("fluid", host.address());
  host.admit({"fluid"}, {false});
  host.ask<Configured>("fluid", {}, Configure{});
  std::thread killer([&] {
    std::this_thread::sleep_for(milliseconds(500));
    child.signal(SIGKILL);
  });
  const auto start = Clock::now();
  try {
    host.ask<FluidAdvanced>("fluid", {77, 12, 2}, FluidAdvance{});
    ADD_FAILURE() << "a dead participant has answered";
  } catch (const ParticipantLost& e) {
    EXPECT_STREQ(e.what(),
                 "fluid (test_program 1.2) has closed its connection, in phase \"factor\" of step 12, "
                 "sub-iteration 2");
  }
  EXPECT_LT(seconds(start), 3);
  killer.join();
  EXPECT_TRUE(host.dismiss("lost").at(0).second.empty());
}

TEST(Life, a_participant_that_stands_still_is_noticed) {
  Host host(options());
  StuckPeer child("fluid", host.address());
  host.admit({"fluid"}, {false});
  host.ask<Configured>("fluid", {}, Configure{});
  child.signal(SIGSTOP);
  const auto start = Clock::now();
  try {
    host.ask<FluidAdvanced>("fluid", {77, 12, 2}, FluidAdvance{});
    ADD_FAILURE() << "a stopped participant has answered";
  } catch (const ParticipantLost& e) {
    EXPECT_NE(std::string(e.what()).find("gave no sign of life for 1 s"), std::string::npos) << e.what();
  }
  EXPECT_LT(seconds(start), 3);
}

/// Standard input that the test writes to, in place of the launcher's pipe.
class LauncherPipe {
 public:
  LauncherPipe() : saved_(dup(STDIN_FILENO)) {
    EXPECT_EQ(pipe(ends_), 0);
    EXPECT_EQ(dup2(ends_[0], STDIN_FILENO), STDIN_FILENO);
  }
  ~LauncherPipe() {
    close_end();
    dup2(saved_, STDIN_FILENO);
    close(saved_);
    close(ends_[0]);
  }
  void write(const std::string& text) const {
    EXPECT_EQ(::write(ends_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void close_end() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int saved_, ends_[2]{-1, -1};
};

TEST(Life, the_launcher_knows_the_exit_status) {
  LauncherPipe launcher;
  HostOptions o = options();
  o.watch_stdin = true;
  o.silence_timeout = 60;
  FluidRun run(o);
  std::atomic<bool> told{false};
  run.fluid.on_advance = [&](auto&, auto&) {
    run.fluid.progress.set("factor");
    std::this_thread::sleep_for(milliseconds(300));  // a heartbeat tells the phase
    launcher.write("noise\nexited fl");
    launcher.write("uid -9\n");
    while (!told) std::this_thread::sleep_for(milliseconds(10));
    return FluidAdvanced{};
  };
  EXPECT_EQ(run.loss(),
            "fluid (test_program 1.2) was killed by signal 9 (SIGKILL), in phase \"factor\" of step 12, "
            "sub-iteration 2");
  told = true;
}

TEST(Life, a_program_that_ends_before_it_joins_is_named) {
  LauncherPipe launcher;
  HostOptions o = options();
  o.watch_stdin = true;
  o.join_timeout = 60;
  Host host(o);
  launcher.write("exited dem 3\n");
  try {
    host.admit({"dem"}, {false});
    FAIL();
  } catch (const ParticipantLost& e) {
    EXPECT_STREQ(e.what(), "dem ended with exit status 3 before it joined");
  }
}

TEST(Life, the_end_of_the_launcher_ends_the_run) {
  LauncherPipe launcher;
  HostOptions o = options();
  o.watch_stdin = true;
  Host host(o);
  launcher.close_end();
  EXPECT_THROW(host.admit({"fluid"}, {true}), Interrupted);
}

TEST(Life, a_participant_ends_when_its_coupler_vanishes) {
  Fluid fluid;
  std::future<int> status;
  {
    Host host(options());
    status = serve_in_thread(fluid, connection_to(host.address()));
    host.admit({"fluid"}, {false});
  }
  ASSERT_EQ(status.wait_for(std::chrono::seconds(5)), std::future_status::ready);
  EXPECT_EQ(status.get(), 3);
}

TEST(Life, a_participant_ends_when_its_coupler_stands_still) {
  const TemporaryFolder folder;
  const std::string address = "ipc://" + folder / "wire";
  const StuckPeer coupler("coupler", address);
  Fluid fluid;
  auto status = serve_in_thread(fluid, connection_to(address));
  EXPECT_EQ(status.wait_for(milliseconds(1500)), std::future_status::timeout)
      << "the coupler lives, but is silent";
  coupler.signal(SIGSTOP);
  ASSERT_EQ(status.wait_for(std::chrono::seconds(5)), std::future_status::ready);
  EXPECT_EQ(status.get(), 3);
}

TEST(Life, a_solver_that_never_returns_ends_with_the_run) {
  Host host(options());
  const StuckPeer fluid("fluid", host.address());
  host.admit({"fluid"}, {false});
  host.ask<Configured>("fluid", {}, Configure{});
  host.while_waiting = [start = Clock::now()] {
    if (seconds(start) > 0.3) Host::interrupt();
  };
  EXPECT_THROW(host.ask<FluidAdvanced>("fluid", {77, 1, 0}, FluidAdvance{}), Interrupted);
  host.dismiss("interrupted");
  EXPECT_EQ(fluid.exit_status(3), 0);
}

TEST(Life, a_hostile_client_disturbs_nobody) {
  FluidRun run;
  std::atomic<bool> stop{false};
  std::atomic<int> rounds{0};
  std::thread hostile([&, address = run.host.address()] {
    for (int round = 0; !stop; rounds = ++round) {
      Client client(address);
      for (const Envelope& envelope : samples::all()) client.send(encode(envelope), round % 3 == 0);
      client.send(Bytes(static_cast<std::size_t>(round % 7) * 1000, 0xff));
    }
  });
  for (std::uint64_t step = 1; step <= 100 || rounds < 50; ++step) EXPECT_TRUE(run.advance(step).converged);
  stop = true;
  hostile.join();
  EXPECT_EQ(run.host.dismiss("done").size(), 1u);
  EXPECT_EQ(run.status.get(), 0);
}

TEST(Life, waiting_calls_back_and_can_be_interrupted) {
  FluidRun run;
  std::atomic<bool> stop{false};
  run.fluid.on_advance = [&](auto&, auto&) {
    while (!stop) std::this_thread::sleep_for(milliseconds(10));
    return FluidAdvanced{};
  };
  int calls = 0;
  run.host.while_waiting = [&] {
    if (++calls == 3) Host::interrupt();
  };
  EXPECT_THROW(run.advance(1), Interrupted);
  EXPECT_EQ(calls, 3);
  stop = true;
  run.host.dismiss("interrupted");
  EXPECT_EQ(run.status.get(), 0);
}

}  // namespace
}  // namespace fpi::proto
