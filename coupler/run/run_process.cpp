#include "run/run_process.hpp"

#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <random>

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "grains/expand.hpp"
#include "output/replace.hpp"
#include "proto/descriptors.hpp"
#include "proto/host.hpp"
#include "proto/token.hpp"
#include "results/end_state.hpp"
#include "results/onset_drives.hpp"
#include "run/admission.hpp"
#include "run/json.hpp"
#include "run/run_folder.hpp"
#include "run/say.hpp"
#include "run/stages.hpp"
#include "run/time_loop.hpp"
#include "scene/reading.hpp"
#include "setup/doubts.hpp"
#include "setup/places.hpp"
#include "setup/plan.hpp"
#include "setup/resolution.hpp"

namespace fpi {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double largest_leak = 0.01;  ///< through the surfaces of bodies, of the flow

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peak_memory_bytes() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) * 1024 : 0;
}

std::uint64_t random_run_number() {
  std::random_device source;
  return (std::uint64_t{source()} << 32) | source();
}

/// Prints where the run stands, ten times a second at most.
class ProgressPrinter {
 public:
  void operator()(const RunProgress& progress) {
    const bool last = progress.step == progress.steps;
    if (!last && last_ && seconds_since(*last_) < 0.1) return;
    last_ = Clock::now();
    say("progress " + to_json(progress));
  }

 private:
  std::optional<Clock::time_point> last_;
};

bool sets(const std::vector<std::string>& overrides, std::string_view key) {
  return std::ranges::any_of(
      overrides, [key](const std::string& text) { return text.substr(0, text.find('=')) == key; });
}

/// All else that a scene says decided what a run has computed so far.
void check_may_be_set(const std::vector<std::string>& overrides) {
  constexpr std::array<std::string_view, 7> keys{"time.end",
                                                 "output.checkpoint_interval",
                                                 "coupling.participant_timeout",
                                                 "fluid.command",
                                                 "fluid.external",
                                                 "dem.command",
                                                 "dem.external"};
  for (const std::string& text : overrides) {
    const std::string key = text.substr(0, text.find('='));
    require(std::ranges::find(keys, key) != keys.end(),
            "a run is resumed with its own scene, of which only {} may be set; got {}: start a new run",
            fmt::join(keys, ", "), key);
  }
}

class RunProcess {
 public:
  explicit RunProcess(const RunOptions& options) : options_(options) {}

  int run() {
    make_folder(options_.folder);
    const FolderLock lock(options_.folder);
    log::open("coupler", options_.folder + "/coupler.log", log::Level::warning);
    try {
      prepare();
      open_address();
      begin();
      admit();
      march();
      reached_end_ = true;
    } catch (const proto::Interrupted&) {
      summary_.reason = "stopped by the user" + where_it_stands();
    } catch (const std::exception& e) {
      summary_.reason = e.what() + where_it_stands();
    }
    finish();
    return summary_.status == "completed" ? 0 : 1;
  }

 private:
  void prepare() {
    if (options_.resume) check_may_be_set(options_.overrides);
    const std::string file = options_.resume ? options_.folder + "/scene.toml" : options_.scene;
    reading_ = scene::read_all(file, options_.overrides);
    reading_.findings.raise();
    StagedScene staged = with_stages(reading_.scene, file, options_.stages);
    Findings findings;
    const std::vector<InputFile> found = find_files(staged, file, Unready::refuse, findings);
    if (!options_.resume) require_outside(options_.folder, file, found);
    files_ = read_files(found, file, findings);
    if (!findings.has_errors()) plan_ = make_plan(staged, files_);
    summary_.origin = {version, plan_.scene_fingerprint};
    scene_ = std::move(staged.scene);
    if (!findings.has_errors())
      findings =
          grains::place(scene_, [this](const std::string& name) { return proto::content(files_, name); });
    take(std::move(findings));
    if (options_.resume) find_checkpoint();
  }

  /// The one to continue from; none where the run had not come so far, and begins anew.
  void find_checkpoint() {
    const bool completed = completed_run(options_.folder).has_value(),
               extends = sets(options_.overrides, "time.end");
    require(!completed || extends,
            "nothing to resume: the run reached its end; --set time.end=… with a later end extends it");
    require(has_checkpoint(options_.folder) || !completed,
            "a checkpoint is required to extend a run; {} has none", options_.folder);
    if (!has_checkpoint(options_.folder)) return;
    const Inputs inputs = inputs_up_to_any_end(scene_, files_);
    checkpoint_ = read_checkpoint(options_.folder, inputs);
    if (checkpoint_->time < scene_.time.end) return;
    require(!extends, "time.end must be later than t = {} s, which the run has come to; got {} s",
            checkpoint_->time, scene_.time.end);
    // It was stopped after its last step, before its figures were written: they come with its last steps.
    checkpoint_ = read_previous_checkpoint(options_.folder, inputs);
    uses_previous_ = true;
  }

  void open_address() {
    proto::raise_descriptor_limit();
    if (options_.keys.empty()) token_.emplace(options_.folder);
    host_ = std::make_unique<proto::Host>(
        proto::HostOptions{.address = options_.listen,
                           .keys = options_.keys,
                           .token = token_ ? token_->token() : "",
                           .run = number_,
                           .scene_fingerprint = plan_.scene_fingerprint,
                           .silence_timeout = scene_.coupling.participant_timeout,
                           .watch_stdin = options_.watch_stdin});
  }

  /// From here on the folder tells of this run.
  void begin() {
    if (uses_previous_) discard_newest_checkpoint(options_.folder);
    if (!checkpoint_) clear_folder(options_.folder);
    remove_unfinished(options_.folder);
    write_inputs(options_.folder, scene_, files_);
    began_ = true;
    // Should this process be killed, this is what the folder says.
    summary_.reason = "the run is under way, or it ended without a word";
    write_summary();
    log::info("{}: {}", checkpoint_ ? "resuming" : "starting", scene_.title);
    if (options_.resume && !checkpoint_) log::warning("there is no checkpoint yet: the run begins anew");
    for (const std::string& line : grains::describe(scene_)) log::info("{}", line);
    take(doubts(scene_));
  }

  void admit() {
    if (token_) say("token " + token_->path());
    say("address " + host_->address());
    for (const PlannedParticipant& participant : plan_.participants) summary_.figures[participant.role];
    admission_ = std::make_unique<Admission>(*host_, plan_.participants, scene_, checkpoint_.has_value(),
                                             number_, timers_);
    run_ = std::make_unique<TimeLoop>(scene_, admission_->participants(), options_.folder, number_, timers_);
    run_->on_progress = ProgressPrinter();
    run_->on_findings = [this](Findings findings) { take(std::move(findings)); };
  }

  /// Throws Error with all errors, each with its place in the scene's file; warns of the rest.
  void take(Findings findings) {
    Places(reading_, scene_).fill(findings);
    findings.raise();
    for (const std::string& line : to_lines(findings.all())) warn(line);
  }
  void warn(const std::string& line) {
    log::warning("{}", line);
    summary_.warnings.push_back(line);
  }

  void march() {
    if (checkpoint_) {
      run_->resume(files_, *checkpoint_);
      summary_.steps_before = run_->statistics().steps();
      checkpoint_.reset();  // it can be large
    } else {
      run_->start(files_);
    }
    summary_.resolution = resolution(scene_, run_->problem());
    for (const std::string& line : describe(summary_.resolution)) log::info("{}", line);
    run_->march();
  }

  std::string where_it_stands() const {
    if (!run_) return "";
    const RunProgress s = run_->progress();
    const std::string further =
        has_checkpoint(options_.folder)
            ? fmt::format("; `./fpi resume {}` continues from the last checkpoint", options_.folder)
            : "";
    const char* kept = s.step > 0 ? "; results up to there are kept" : ", the first";
    return fmt::format(" (at step {} of about {}, t = {} s of {} s{}{})", s.step, s.steps, s.time, s.end,
                       kept, further);
  }

  void finish() {
    if (!reached_end_) log::error("{}", summary_.reason);
    if (options_.resume && !began_) return;  // refused: the summary is still that of the run before
    if (host_) {
      const std::string goodbye = reached_end_ ? "the run is complete" : summary_.reason;
      for (auto& [role, figures] : host_->dismiss(goodbye)) summary_.figures[role] = std::move(figures);
    }
    try {
      close_folder();
    } catch (const std::exception& e) {
      log::error("the results could not be completed: {}", e.what());
      if (reached_end_) summary_.reason = e.what();
      summary_.status = "failed";
      write_failure();
    }
    log::info("{} after {} steps: {:.3g} s, of which coupling {:.3g} s and output {:.3g} s", summary_.status,
              summary_.statistics.steps(), summary_.wall_total, summary_.wall_coupling, summary_.wall_output);
    for (const std::string& line : coupling_table(summary_)) log::info("{}", line);
    log::flush();
  }

  /// A run is completed once all its results are on the disk; nothing is written after the word that says so.
  void close_folder() {
    if (run_) collect_results();
    if (reached_end_) {
      write_final_bodies(scene_, run_->problem().state(), options_.folder);
      output::sync_folder(options_.folder);
      summary_.status = "completed";
      summary_.reason.clear();
    }
    write_summary();
  }

  void write_failure() {
    try {
      write_summary();
    } catch (const std::exception& e) {
      log::error("the summary could not be written: {}", e.what());
    }
  }

  void collect_results() {
    warn_of_leak();
    summary_.statistics = run_->statistics();
    if (const auto worst = summary_.statistics.worst())
      summary_.worst_body = run_->problem().body_of(worst->unknown);
    summary_.bodies = run_->problem().state();
    for (std::size_t i = 0; i < scene_.n_listed(); ++i) summary_.body_names.push_back(scene_.bodies[i].name);
    for (const scene::Outlet& outlet : scene_.outlets) summary_.outlet_names.push_back(outlet.name);
    if (const std::optional<Onset>& onset = summary_.bodies.onset) {
      summary_.onset_body = scene_.bodies[onset->body].name;
      summary_.onset_drives = drives_at(*onset, scene_, options_.folder);
    }
    summary_.groups = group_motions(scene_, summary_.bodies);
    const Reported& last = run_->last_reported();
    for (std::size_t i = 0; i < last.probes.size(); ++i)
      summary_.probes[scene_.probes[i].name] = last.probes[i];
    const std::vector<std::string> drives = found_drives(scene_);
    for (std::size_t i = 0; i < last.drives.size(); ++i) summary_.drives[drives[i]] = last.drives[i];
    for (std::size_t i = 0; i < last.coefficients.size(); ++i) {
      summary_.coefficients[column_of(scene_.coefficients[i], "drag")] = last.coefficients[i].drag;
      summary_.coefficients[column_of(scene_.coefficients[i], "lift")] = last.coefficients[i].lift;
    }
    summary_.boundary_names = holding_boundaries(scene_);
    summary_.boundaries = last.boundaries;
    for (const scene::Profile& profile : scene_.profiles) summary_.profile_names.push_back(profile.name);
    if (run_->problem().steps() == 0) return;
    summary_.signals = measure_signals(scene_, options_.folder);
    write_extrema(summary_.signals, options_.folder);
  }

  void warn_of_leak() {
    const double share = leak_share(summary_);
    if (share <= largest_leak) return;
    // The table at the end of a run says it too, with the figure of every run.
    const std::string line = fmt::format(
        "{:.2g} % of the flow goes through the surfaces of bodies: smaller elements let less through, or a "
        "smaller fluid.embedding.arc_ratio, not below 0.9",
        100 * share);
    log::info("{}", line);
    summary_.warnings.push_back(line);
  }

  void write_summary() {
    summary_.wall_total = seconds_since(start_);
    summary_.wall_output = timers_.seconds["output"];
    summary_.wall_coupling = summary_.wall_total - summary_.wall_output;
    constexpr std::string_view waiting = "waiting:";
    for (const auto& [name, seconds] : timers_.seconds) {
      if (!name.starts_with(waiting)) continue;
      summary_.waited_for[name.substr(waiting.size())] = seconds;
      summary_.wall_coupling -= seconds;
    }
    summary_.peak_memory = peak_memory_bytes();
    output::replace_text(options_.folder + "/summary.json", to_json(summary_));
  }

  const RunOptions& options_;
  const Clock::time_point start_ = Clock::now();
  Timers timers_;
  scene::Reading reading_;
  scene::Scene scene_;
  Plan plan_;
  const std::uint64_t number_ = random_run_number();
  std::optional<Checkpoint> checkpoint_;  ///< to resume from
  bool uses_previous_ = false, began_ = false, reached_end_ = false;
  Files files_;
  std::optional<proto::TokenFile> token_;  ///< where there are no keys
  std::unique_ptr<proto::Host> host_;
  std::unique_ptr<Admission> admission_;
  std::unique_ptr<TimeLoop> run_;
  Summary summary_;
};

}  // namespace

int run_process(const RunOptions& options) { return RunProcess(options).run(); }

}  // namespace fpi
