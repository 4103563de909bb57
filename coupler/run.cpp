#include "run.hpp"

#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"

namespace fpi {

Run::Run(const scene::Scene& scene, Participants participants, std::string folder, std::uint64_t run,
         Ledger& ledger)
    : scene_(scene),
      participants_(participants),
      folder_(std::move(folder)),
      ledger_(ledger),
      simulation_(scene, participants, run),
      window_(scene.time, scene.output.interval) {
  simulation_.after_exchange = [this](std::uint32_t exchanges) {
    sub_iterations_ = exchanges;
    report_progress();
  };
}

void Run::start(const Files& files) {
  simulation_.configure(files, {});
  recorder_.emplace(scene_, folder_);
  if (!scene_.time.steady && window_.step() != scene_.time.step) {
    log::info("the time step is {} s instead of {} s (time.step), so that output times and the end are hit",
              window_.step(), scene_.time.step);
  }
}

void Run::resume(const Files& files, const Checkpoint& checkpoint) {
  simulation_.configure(files, checkpoint.participants);
  simulation_.set_numbers(checkpoint.simulation);
  window_.set_state(checkpoint.time_window);
  fields_time_ = window_.start();  // a fluid has none of its resumed state: it knows no bodies before a step
  statistics_.set_numbers(checkpoint.statistics);
  recorder_.emplace(scene_, folder_, checkpoint.file_sizes);
  log::info("resumed after step {}, t = {} s", simulation_.steps(), window_.start());
}

void Run::march() {
  if (scene_.time.steady) return solve_steady();
  const auto every = static_cast<std::uint64_t>(scene_.output.checkpoint_every);
  while (!window_.done()) {
    take_step();
    if (every > 0 && simulation_.steps() % every == 0) save_checkpoint();
  }
}

void Run::solve_steady() {
  const Attempt attempt = simulation_.attempt(0, 0, 0);
  if (!attempt.converged) fail("the steady state was not found: {}", attempt.reason);
  simulation_.accept();
  record(0, attempt, true);
}

void Run::take_step() {
  const Attempt attempt = good_attempt();
  const double time = window_.end();
  const bool fields_due = window_.ends_at_output() || simulation_.steps() == 0;
  simulation_.accept();
  window_.accept(attempt.time_error);
  record(time, attempt, fields_due);
}

/// A step that does not converge is restored, halved and tried again, one whose error in time is too large is
/// made as small as that asks for.
Attempt Run::good_attempt() {
  for (;;) {
    Attempt attempt = simulation_.attempt(window_.start(), window_.end(), window_.step());
    if (attempt.converged && is_fine_enough(attempt.time_error)) return attempt;
    simulation_.restore();
    if (!attempt.converged) {
      log::warning("step {} to t = {} s rejected: {}", simulation_.steps() + 1, window_.end(),
                   attempt.reason);
      if (!window_.halve()) give_up(attempt.reason);
    }
    log::info("trying again with a step of {} s", window_.step());
  }
}

bool Run::is_fine_enough(const coupling::TimeError& error) {
  const double tried = window_.step();
  const coupling::Verdict verdict = window_.judge(error);
  if (verdict == coupling::Verdict::repeat)
    log::info(
        "step {} from t = {} s repeated: with {} s its error in time is {:.2g} (time.relative_tolerance = "
        "{})",
        simulation_.steps() + 1, window_.start(), tried, error.value, scene_.time.relative_tolerance);
  if (verdict == coupling::Verdict::take_at_smallest && !std::exchange(told_of_smallest_step_, true))
    log::warning(
        "at t = {} s the smallest step, {} s (time.min_step), has an error in time of {:.2g}, above "
        "time.relative_tolerance = {}: taken all the same, now and later",
        window_.start(), tried, error.value, scene_.time.relative_tolerance);
  return verdict != coupling::Verdict::repeat;
}

void Run::give_up(const std::string& reason) {
  if (simulation_.steps() > 0) write_fields(window_.start());
  fail(
      "step {} from t = {} s did not converge, although it was halved {} times (time.max_halvings), down to "
      "{} s: {}",
      simulation_.steps() + 1, window_.start(), scene_.time.max_halvings, window_.step(), reason);
}

void Run::record(double time, const Attempt& attempt, bool fields_due) {
  reported_ = reported(scene_, simulation_);
  statistics_.add_step(attempt.sub_iterations, attempt.largest_overlap);
  log::debug("step {}: t = {} s, {} sub-iterations, residual of velocity {:.2g}, of force {:.2g}",
             simulation_.steps(), time, attempt.sub_iterations, attempt.velocity.relative,
             attempt.force.relative);
  {
    const ScopedTimer timer(ledger_, "output");
    recorder_->record_step(time, attempt, simulation_, reported_);
    if (fields_due || scene_.grains.empty()) recorder_->record_bodies(time, simulation_.state());
  }
  if (fields_due) write_fields(time);
  report_progress();
}

/// Fields and tractions of the accepted state, once for a time.
void Run::write_fields(double time) {
  if (!scene_.output.fields || fields_time_ == time) return;
  fields_time_ = time;
  proto::Fields fields;
  if (participants_.fluid && fluid_has_fields_)
    fields = participants_.fluid->write({.mesh = recorder_->wants_mesh()});
  const ScopedTimer timer(ledger_, "output");
  recorder_->record_interface(time, simulation_.state());
  if (!fields.fields.empty()) {
    recorder_->record_fields(time, fields);
  } else if (participants_.fluid && std::exchange(fluid_has_fields_, false)) {
    log::info("the fluid sends no fields: none are written");
  }
}

void Run::save_checkpoint() {
  StatesByRole states;
  if (participants_.fluid) states["fluid"] = participants_.fluid->checkpoint().bytes;
  if (participants_.dem) states["dem"] = participants_.dem->checkpoint().bytes;
  const ScopedTimer timer(ledger_, "output");
  recorder_->flush();
  write_checkpoint(folder_,
                   {.simulation = simulation_.numbers(),
                    .time_window = window_.state(),
                    .statistics = statistics_.numbers(),
                    .file_sizes = recorder_->sizes(),
                    .participants = std::move(states)},
                   scene::fingerprint(scene_));
  log::debug("checkpoint after step {}", simulation_.steps());
}

Standing Run::standing() const {
  const std::uint64_t step = simulation_.steps();
  if (scene_.time.steady)
    return {.step = step, .steps = 1, .time = 0, .end = 0, .sub_iterations = sub_iterations_};
  return {.step = step,
          .steps = step + static_cast<std::uint64_t>(window_.steps_left()),
          .time = window_.start(),
          .end = scene_.time.end,
          .sub_iterations = sub_iterations_};
}

void Run::report_progress() {
  if (on_progress) on_progress(standing());
}

}  // namespace fpi
