#include "run/admission.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/log.hpp"

namespace fpi {
namespace {

/// Returns whether it can save its state.
bool check_hello(const proto::Hello& hello, const scene::Scene& scene, bool resumes) {
  log::info("{}: {} {}", hello.role, hello.program, hello.program_version);
  const bool can_save = std::ranges::find(hello.capabilities, "checkpoint") != hello.capabilities.end();
  if (!can_save) log::info("{} offers no checkpoints: none are written", hello.program);
  require(can_save || (scene.output.checkpoint_every == 0 && !resumes),
          "a checkpoint needs every participant to offer it; {} ({}) does not: set output.checkpoint_every "
          "= 0 or use another program",
          hello.program, hello.role);
  return can_save;
}

}  // namespace

Admission::Admission(proto::Host& host, const std::vector<PlannedParticipant>& roles,
                     const scene::Scene& scene, bool resumes, std::uint64_t run, Timers& timers) {
  std::vector<std::string> names;
  std::vector<bool> external;
  for (const PlannedParticipant& participant : roles) {
    names.push_back(participant.role);
    external.push_back(participant.external);
  }
  std::set<std::string> offered;
  bool all_save = true;
  for (const proto::Hello& hello : host.admit(names, external)) {
    all_save = check_hello(hello, scene, resumes) && all_save;
    offered.insert(hello.capabilities.begin(), hello.capabilities.end());
  }
  const auto is_there = [&](const char* role) { return std::ranges::find(names, role) != names.end(); };
  if (is_there("fluid")) fluid_.emplace(host, "fluid", run, timers);
  if (is_there("dem")) dem_.emplace(host, "dem", run, timers);
  participants_ = {.fluid = fluid_ ? &*fluid_ : nullptr,
                   .dem = dem_ ? &*dem_ : nullptr,
                   .fluid_moves_bodies = offered.contains("balance"),
                   .dem_takes_added_inertia = offered.contains("added_inertia"),
                   .dem_takes_resistance = offered.contains("resistance"),
                   .save_their_state = all_save};
}

}  // namespace fpi
