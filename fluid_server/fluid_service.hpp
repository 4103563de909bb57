/// The fluid as a participant: message → library call → reply. Forces leave here for the scene's thickness.
#pragma once

#include <optional>

#include "fluid/navier_stokes.hpp"
#include "proto/participant.hpp"
#include "resolution_report.hpp"
#include "scene/scene.hpp"

namespace fpi::fluid {

class FluidService : public proto::FluidParticipant {
 public:
  proto::Configured configure(const proto::Configure& message) override;
  proto::FluidAdvanced advance(const proto::Stamp& stamp, const proto::FluidAdvance& message) override;
  proto::Accepted accept(const proto::Accept&) override;
  void restore() override;
  proto::Fields write(const proto::Write& message) override;
  proto::State checkpoint() override;
  proto::Figures report() override;

 private:
  void make_solver(const std::vector<proto::File>& files, Findings& findings);
  std::vector<proto::ArcLength> arc_lengths(const Mesh& mesh, const Locator& locator,
                                            Findings& findings) const;
  NavierStokes& solver();

  scene::Scene scene_;
  std::optional<NavierStokes> solver_;
  ResolutionReport resolution_;
  proto::Figures permeability_;  ///< found with the accepted steady flow
};

}  // namespace fpi::fluid
