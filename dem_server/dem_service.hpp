/// The DEM as a participant: message → library call → reply.
#pragma once

#include <optional>

#include "core/timer.hpp"
#include "dem/solver.hpp"
#include "proto/participant.hpp"

namespace fpi::dem {

class DemService : public proto::DemParticipant {
 public:
  proto::Configured configure(const proto::Configure& message) override;
  proto::DemAdvanced advance(const proto::Stamp& stamp, const proto::DemAdvance& message) override;
  proto::Accepted accept(const proto::Accept&) override;
  void restore() override;
  proto::State checkpoint() override;
  proto::Figures report() override;

 private:
  Solver& solver();
  proto::Figures energies() const;

  std::optional<Solver> solver_;
  double time_ = 0;          ///< [s] at the end of the last step tried
  double longest_step_ = 0;  ///< [s] that a step of the scene can have
  Timers timers_;
};

}  // namespace fpi::dem
