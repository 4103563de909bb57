/// The participants that join a run over the wire, and what they can.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/timer.hpp"
#include "proto/host.hpp"
#include "run/remote.hpp"
#include "setup/plan.hpp"
#include "step/solver_requests.hpp"

namespace fpi {

class Admission {
 public:
  /// Waits for all `roles`. Throws Error where one cannot what the scene asks for; `resumes`: a run goes on
  /// from a checkpoint.
  Admission(proto::Host& host, const std::vector<PlannedParticipant>& roles, const scene::Scene& scene,
            bool resumes, std::uint64_t run, Timers& timers);
  Admission(const Admission&) = delete;
  Admission& operator=(const Admission&) = delete;

  const Participants& participants() const { return participants_; }

 private:
  std::optional<RemoteFluid> fluid_;
  std::optional<RemoteDem> dem_;
  Participants participants_;
};

}  // namespace fpi
