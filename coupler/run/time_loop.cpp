#include "run/time_loop.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "output/replace.hpp"

namespace fpi {

TimeLoop::TimeLoop(const scene::Scene& scene, Participants participants, std::string folder,
                   std::uint64_t run, Timers& timers)
    : scene_(scene),
      participants_(participants),
      folder_(std::move(folder)),
      timers_(timers),
      problem_(scene, participants, run),
      window_(scene.time, scene.output.interval) {
  problem_.after_sub_iteration = [this](std::uint32_t exchanges) {
    sub_iterations_ = exchanges;
    report_progress();
  };
}

void TimeLoop::start(const Files& files) {
  inputs_ = inputs_up_to_any_end(scene_, files);
  tell(problem_.configure(files, {}));
  recorder_.emplace(scene_, folder_);
  if (!scene_.time.steady && window_.step() != scene_.time.step) {
    log::info("the time step is {} s instead of {} s (time.step), so that output times and the end are hit",
              window_.step(), scene_.time.step);
  }
  start_suddenly();
}

void TimeLoop::start_suddenly() {
  const std::optional<Attempt> impulse = problem_.start_suddenly(window_.step());
  if (!impulse) return;
  window_.start_suddenly();
  if (impulse->converged)
    log::info("bodies or fluid start with a velocity: the impulse between them at the start was solved for");
  else
    log::warning(
        "bodies or fluid start with a velocity, and the impulse between them was not found ({}): the first "
        "step takes it up, which is less accurate",
        impulse->reason);
}

void TimeLoop::resume(const Files& files, const Checkpoint& checkpoint) {
  inputs_ = checkpoint.inputs;
  tell(problem_.configure(files, checkpoint.participants));
  problem_.set_numbers(checkpoint.problem);
  window_.set_state(checkpoint.time_window);
  fields_time_ = window_.start();  // a fluid has none of its resumed state: it knows no bodies before a step
  statistics_.set_numbers(checkpoint.statistics);
  recorder_.emplace(scene_, folder_, checkpoint.file_sizes);
  log::info("resumed after step {}, t = {} s", problem_.steps(), window_.start());
}

void TimeLoop::march() {
  try {
    scene_.time.steady ? solve_steady() : take_steps();
  } catch (...) {
    keep_results();
    throw;
  }
  recorder_->flush();
}

/// The steps at which a run may be resumed do not depend on the clock: all participants go on there as if
/// they were resumed, whether or not a checkpoint is written.
void TimeLoop::take_steps() {
  while (!window_.done()) {
    take_step();
    if (!is_resumable()) continue;
    resumable_ = state_now();
    if (checkpoint_is_due()) save_checkpoint();
  }
}

bool TimeLoop::is_resumable() const {
  const std::int64_t every = participants_.save_their_state ? scene_.output.resumable_every() : 0;
  return every > 0 && (window_.done() || problem_.steps() % static_cast<std::uint64_t>(every) == 0);
}

bool TimeLoop::checkpoint_is_due() const {
  const std::chrono::duration<double> interval(scene_.output.checkpoint_interval);
  return scene_.output.checkpoint_every > 0 || window_.done() ||
         std::chrono::steady_clock::now() - saved_ > std::max(interval, 100 * saving_takes_);
}

/// What a run that fails or is stopped leaves behind.
void TimeLoop::keep_results() {
  try {
    if (recorder_) recorder_->flush();
    if (resumable_) save_checkpoint();
  } catch (const std::exception& e) {
    log::error("results could not be kept: {}", e.what());
  }
}

void TimeLoop::solve_steady() {
  const Attempt attempt = problem_.attempt(0, 0, 0);
  if (!attempt.converged) fail("the steady state was not found: {}", attempt.reason);
  problem_.accept();
  record(0, attempt, true);
}

void TimeLoop::take_step() {
  const Attempt attempt = good_attempt();
  const double time = window_.end();
  const bool fields_due = window_.ends_at_output() || problem_.steps() == 0;
  problem_.accept();
  window_.accept(demands(attempt));
  record(time, attempt, fields_due);
}

/// What the scene bounds in a step that it lets adapt.
std::vector<coupling::Demand> TimeLoop::demands(const Attempt& attempt) const {
  const scene::Time& asked = scene_.time;
  std::vector<coupling::Demand> demands;
  if (asked.relative_tolerance > 0 && attempt.time_error.order > 0)
    demands.push_back({.what = "error in time (time.relative_tolerance)",
                       .excess = attempt.time_error.value / asked.relative_tolerance,
                       .order = attempt.time_error.order});
  if (asked.max_displacement > 0)
    demands.push_back({.what = "way of a body (time.max_displacement)",
                       .excess = attempt.displacement / asked.max_displacement,
                       .most = 1});
  if (asked.wanted_sub_iterations > 0)
    demands.push_back({.what = "number of sub-iterations (time.wanted_sub_iterations)",
                       .excess = attempt.sub_iterations / static_cast<double>(asked.wanted_sub_iterations),
                       .most = std::numeric_limits<double>::infinity()});
  return demands;
}

/// A step that does not converge is restored, halved and tried again, one with too large an error or way is
/// made as small as that asks for.
Attempt TimeLoop::good_attempt() {
  for (;;) {
    Attempt attempt = problem_.attempt(window_.start(), window_.end(), window_.step());
    tell_of_stalls(attempt);
    if (attempt.converged && is_fine_enough(demands(attempt))) return attempt;
    problem_.restore();
    if (attempt.converged) {
      statistics_.add_repeated();
    } else {
      statistics_.add_rejected();
      log::warning("step {} to t = {} s rejected: {}", problem_.steps() + 1, window_.end(), attempt.reason);
      if (!window_.halve()) give_up(attempt.reason);
    }
    log::info("trying again with a step of {} s", window_.step());
  }
}

bool TimeLoop::is_fine_enough(const std::vector<coupling::Demand>& demands) {
  const double tried = window_.step();
  const coupling::Verdict verdict = window_.judge(demands);
  if (verdict == coupling::Verdict::take) return true;
  const coupling::Demand& worst = *std::ranges::max_element(
      demands, {}, [](const coupling::Demand& demand) { return demand.excess / demand.most; });
  const std::string excess =
      fmt::format("with {} s its {} is {:.2g} of what is allowed", tried, worst.what, worst.excess);
  if (verdict == coupling::Verdict::repeat)
    log::info("step {} from t = {} s repeated: {}", problem_.steps() + 1, window_.start(), excess);
  else if (!std::exchange(told_of_smallest_step_, true))
    log::warning(
        "step {} from t = {} s has the smallest size (time.min_step): {}; taken all the same, now and later",
        problem_.steps() + 1, window_.start(), excess);
  return verdict != coupling::Verdict::repeat;
}

/// Each remedy once in a run, with the body at fault; the report counts them all.
void TimeLoop::tell_of_stalls(const Attempt& attempt) {
  statistics_.add_stalls(attempt);
  for (const coupling::StallEvent& event : attempt.stalls) {
    const auto remedy = static_cast<std::size_t>(event.remedy);
    if (std::exchange(told_of_remedy_.at(remedy), true)) continue;
    constexpr std::array<const char*, 3> remedies{"what was learnt before is dropped",
                                                  "Aitken's relaxation goes on", "the step is made shorter"};
    log::warning("step {}: the coupling {} most of all at body \"{}\": {} (said once)", problem_.steps() + 1,
                 event.stall == coupling::Stall::cycle ? "goes round in a cycle," : "stagnates,",
                 problem_.body_of(event.unknown), remedies.at(remedy));
  }
}

void TimeLoop::give_up(const std::string& reason) {
  if (problem_.steps() > 0) write_fields(window_.start());
  fail(
      "step {} from t = {} s did not converge, although it was halved {} times (time.max_halvings), down to "
      "{} s: {}",
      problem_.steps() + 1, window_.start(), scene_.time.max_halvings, window_.step(), reason);
}

void TimeLoop::record(double time, const Attempt& attempt, bool fields_due) {
  reported_ = reported(scene_, problem_);
  statistics_.add_step(attempt);
  tell(problem_.take_findings());
  log::debug("step {}: t = {} s, {} sub-iterations, residual of velocity {:.2g}, of force {:.2g}",
             problem_.steps(), time, attempt.sub_iterations, attempt.velocity.relative,
             attempt.force.relative);
  {
    const ScopedTimer timer(timers_, "output");
    recorder_->record_step(time, attempt, problem_, reported_);
    if (fields_due || scene_.grains.empty()) recorder_->record_bodies(time, problem_.state());
  }
  if (fields_due) write_fields(time);
  report_progress();
}

/// Fields and tractions of the accepted state, once for a time.
void TimeLoop::write_fields(double time) {
  if (!scene_.output.fields || fields_time_ == time) return;
  fields_time_ = time;
  proto::Fields fields;
  if (participants_.fluid && fluid_has_fields_)
    fields = participants_.fluid->write({.mesh = recorder_->wants_mesh()});
  const ScopedTimer timer(timers_, "output");
  recorder_->record_interface(time, problem_.state());
  if (!fields.fields.empty()) {
    recorder_->record_fields(time, fields);
  } else if (participants_.fluid && std::exchange(fluid_has_fields_, false)) {
    log::info("the fluid sends no fields: none are written");
  }
}

Checkpoint TimeLoop::state_now() {
  StatesByRole states;
  if (participants_.fluid) states["fluid"] = participants_.fluid->checkpoint().bytes;
  if (participants_.dem) states["dem"] = participants_.dem->checkpoint().bytes;
  return {.inputs = inputs_,
          .time = window_.start(),
          .problem = problem_.numbers(),
          .time_window = window_.state(),
          .statistics = statistics_.numbers(),
          .file_sizes = recorder_->sizes(),
          .participants = std::move(states)};
}

/// A checkpoint names rows and steps of result files, so that these must be on the disk before it.
void TimeLoop::save_checkpoint() {
  const ScopedTimer timer(timers_, "output");
  const auto start = std::chrono::steady_clock::now();
  recorder_->flush();
  output::sync_folder(folder_);
  write_checkpoint(folder_, *resumable_);
  log::debug("checkpoint after step {}", resumable_->problem.at("steps").front());
  resumable_.reset();  // it can be large
  saved_ = std::chrono::steady_clock::now();
  saving_takes_ = saved_ - start;
}

RunProgress TimeLoop::progress() const {
  const std::uint64_t step = problem_.steps();
  if (scene_.time.steady)
    return {.step = step, .steps = 1, .time = 0, .end = 0, .sub_iterations = sub_iterations_};
  return {.step = step,
          .steps = step + static_cast<std::uint64_t>(window_.steps_left()),
          .time = window_.start(),
          .end = scene_.time.end,
          .sub_iterations = sub_iterations_};
}

void TimeLoop::tell(const Findings& findings) const {
  if (on_findings && !findings.all().empty()) return on_findings(findings);
  findings.raise();
  for (const std::string& line : to_lines(findings.all())) log::warning("{}", line);
}

void TimeLoop::report_progress() {
  if (on_progress) on_progress(progress());
}

}  // namespace fpi
