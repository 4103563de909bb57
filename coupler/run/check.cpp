#include "run/check.hpp"

#include <algorithm>
#include <memory>
#include <random>

#include "core/log.hpp"
#include "coupling/time_window.hpp"
#include "grains/expand.hpp"
#include "proto/token.hpp"
#include "run/admission.hpp"
#include "run/json.hpp"
#include "run/run_folder.hpp"
#include "run/say.hpp"
#include "run/stages.hpp"
#include "scene/reading.hpp"
#include "setup/beyond_folder.hpp"
#include "setup/doubts.hpp"
#include "setup/places.hpp"

namespace fpi {
namespace {

class Check {
 public:
  explicit Check(const RunOptions& options) : options_(options) { report_.scene = options.scene; }

  CheckReport run() {
    try {
      if (read() && read_stages() && place_bodies()) ask_participants();
    } catch (const proto::Interrupted&) {
      throw;
    } catch (const std::exception& e) {
      found_.error("", "{}", e.what());
    }
    if (reading_.document) Places(reading_, scene_, groups_).fill(found_);
    report_.findings = std::move(found_);
    return std::move(report_);
  }

 private:
  /// Whether the scene has all its values, so that more can be asked of it.
  bool read() {
    reading_ = scene::read_all(options_.scene, options_.overrides);
    found_.append(reading_.findings.all());
    report_.plan.title = reading_.scene.title;
    return reading_.has_all_values;
  }

  bool read_stages() {
    StagedScene staged;
    if (!found_.attempt("grains",
                        [&] { staged = with_stages(reading_.scene, options_.scene, options_.stages); }))
      return false;
    for (const std::string& sentence : beyond_folder(staged, options_.scene)) found_.warn("", "{}", sentence);
    const StagedScene whole = staged;
    leave_out_what_is_not_ready(staged);
    files_ =
        read_files(find_files(staged, options_.scene, Unready::leave_out, found_), options_.scene, found_);
    if (!has_new_errors()) report_.plan = make_plan(whole, files_);
    scene_ = std::move(staged.scene);
    return !has_new_errors();
  }

  /// Grains that another scene's run still has to settle have no places yet.
  void leave_out_what_is_not_ready(StagedScene& staged) {
    std::vector<scene::Grains> placed;
    for (std::size_t g = 0; g < staged.scene.grains.size(); ++g) {
      scene::Grains& group = staged.scene.grains[g];
      const auto stage = std::ranges::find(staged.stages, group.file, &Stage::table);
      if (stage == staged.stages.end() || stage->ready) {
        groups_.push_back(g);
        placed.push_back(std::move(group));
      } else {
        report_.not_checked.push_back(
            fmt::format("where the grains \"{}\" are: {} settles them first, and has not run yet", group.name,
                        stage->scene));
      }
    }
    staged.scene.grains = std::move(placed);
  }

  bool place_bodies() {
    found_.append(grains::place(scene_, [this](const std::string& name) {
                    return proto::content(files_, name);
                  }).all());
    if (has_new_errors()) return false;
    found_.append(doubts(scene_).all());
    report_.notes = grains::describe(scene_);
    return true;
  }

  /// Unknown keys do not keep a scene from being looked at as if they were not there.
  bool has_new_errors() const {
    return std::ranges::count_if(found_.all(), &Finding::is_error) >
           static_cast<std::ptrdiff_t>(reading_.findings.all().size());
  }

  void ask_participants() {
    std::vector<PlannedParticipant> ours;
    for (const PlannedParticipant& participant : report_.plan.participants) {
      const bool is_needed = participant.role == "fluid" || scene_.needs_dem();
      if (!is_needed) continue;  // its bodies are not known yet
      if (!participant.external && participant.command.empty())
        ours.push_back(participant);
      else
        report_.not_checked.push_back(
            fmt::format("what the {} program says: it is not our own", participant.role));
    }
    if (ours.empty()) return;
    if (!options_.watch_stdin) {
      report_.not_checked.emplace_back("what fluid and dem programs say: `./fpi check` starts them");
      return;
    }
    plan_to_start_ = report_.plan;
    plan_to_start_.participants = ours;
    std::optional<proto::TokenFile> token;
    if (options_.keys.empty()) token.emplace(options_.folder.empty() ? "." : options_.folder);
    proto::Host host({.address = options_.listen,
                      .keys = options_.keys,
                      .token = token ? token->token() : "",
                      .run = number_,
                      .scene_fingerprint = plan_to_start_.scene_fingerprint,
                      .silence_timeout = scene_.coupling.participant_timeout,
                      .watch_stdin = true});
    say("plan " + to_json(plan_to_start_));
    if (token) say("token " + token->path());
    say("address " + host.address());
    found_.attempt("", [&] { rehearse(host, ours); });
    host.dismiss("the scene is checked");
  }

  void rehearse(proto::Host& host, const std::vector<PlannedParticipant>& ours) {
    Admission admission(host, ours, scene_, false, number_, timers_);
    Participants participants = admission.participants();
    if (!participants.fluid) participants.fluid_moves_bodies = true;  // for all we know
    CoupledProblem problem(scene_, participants, number_);
    Findings configured = problem.configure(files_, {});
    const bool refused = configured.has_errors();
    found_.append(configured.all());
    if (refused) return;
    report_.resolution = resolution(scene_, problem);
    const coupling::TimeWindow window(scene_.time, scene_.output.interval);
    const bool steady = scene_.time.steady;
    found_.append(problem.rehearse(steady ? 0 : window.end(), steady ? 0 : window.step()).all());
  }

  const RunOptions& options_;
  const std::uint64_t number_ = std::random_device()();
  scene::Reading reading_;
  scene::Scene scene_;               ///< with the grains that have places
  std::vector<std::size_t> groups_;  ///< their numbers in the file
  Files files_;
  Plan plan_to_start_;
  Timers timers_;
  Findings found_;
  CheckReport report_;
};

}  // namespace

int check_scene(const RunOptions& options, bool json) {
  log::open("coupler", "", log::Level::error);  // what matters is in the report
  const CheckReport report = Check(options).run();
  if (json)
    say("report " + to_json(report));
  else
    for (const std::string& line : to_text(report)) say(line);
  return report.is_ok() ? 0 : 1;
}

}  // namespace fpi
