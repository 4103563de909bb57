/// A run from its first step to its end: the time loop, steps that fail, results, checkpoints. The
/// participants may be in this process or at the other end of the wire.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "core/timer.hpp"
#include "coupling/time_window.hpp"
#include "results/recorder.hpp"
#include "results/statistics.hpp"
#include "run/checkpoint.hpp"
#include "step/coupled_problem.hpp"

namespace fpi {

/// Where a run stands.
struct RunProgress {
  std::uint64_t step = 0, steps = 0;  ///< accepted; an estimate of all
  double time = 0, end = 0;           ///< [s]
  std::uint32_t sub_iterations = 0;   ///< of the step under way, or of the last
};

class TimeLoop {
 public:
  /// `folder` must exist; `timers.seconds["output"]` takes the time spent on writing.
  TimeLoop(const scene::Scene& scene, Participants participants, std::string folder, std::uint64_t run,
           Timers& timers);

  TimeLoop(const TimeLoop&) = delete;
  TimeLoop& operator=(const TimeLoop&) = delete;

  /// Configures the participants and begins at t = 0 with new result files.
  void start(const Files& files);
  /// Configures the participants as the checkpoint has them and continues there.
  void resume(const Files& files, const Checkpoint& checkpoint);

  /// To the end, with a checkpoint there. Throws Error with the reason where that cannot be reached; results
  /// up to there are in the files, and the last state that the run can be resumed from is a checkpoint.
  void march();

  const CoupledProblem& problem() const { return problem_; }
  const Statistics& statistics() const { return statistics_; }
  const Reported& last_reported() const { return reported_; }
  RunProgress progress() const;

  std::function<void(const RunProgress&)> on_progress;
  /// Called with what is found before the first step and later; errors end the run. Where it is empty,
  /// warnings go to the log.
  std::function<void(Findings)> on_findings;

 private:
  Attempt good_attempt();
  std::vector<coupling::Demand> demands(const Attempt& attempt) const;
  bool is_fine_enough(const std::vector<coupling::Demand>& demands);
  void tell_of_stalls(const Attempt& attempt);
  void start_suddenly();
  void solve_steady();
  void take_step();
  [[noreturn]] void give_up(const std::string& reason);
  void record(double time, const Attempt& attempt, bool fields_due);
  void write_fields(double time);
  void take_steps();
  void keep_results();
  bool is_resumable() const;
  bool checkpoint_is_due() const;
  Checkpoint state_now();
  void save_checkpoint();
  void report_progress();
  void tell(const Findings& findings) const;

  const scene::Scene& scene_;
  Participants participants_;
  std::string folder_;
  Timers& timers_;
  CoupledProblem problem_;
  coupling::TimeWindow window_;
  Statistics statistics_;
  Reported reported_;
  Inputs inputs_;
  std::optional<Recorder> recorder_;
  std::optional<Checkpoint>
      resumable_;  ///< the last state that the run can be resumed from, unless it is on disk
  std::chrono::steady_clock::time_point saved_ =
      std::chrono::steady_clock::now();  ///< when one was written last
  std::chrono::duration<double> saving_takes_{};
  std::optional<double> fields_time_;  ///< [s] of the last fields written
  bool fluid_has_fields_ = true, told_of_smallest_step_ = false;
  std::array<bool, 3> told_of_remedy_{};
  std::uint32_t sub_iterations_ = 0;
};

}  // namespace fpi
