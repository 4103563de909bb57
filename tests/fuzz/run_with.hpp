/// A run of the coupler in this process, in which one participant says what an input says.
#pragma once

#include "../unit/temporary_folder.hpp"
#include "conversation.hpp"
#include "core/timer.hpp"
#include "run.hpp"
#include "scene/scene.hpp"

namespace fpi::fuzz {

/// A participant of a role whose answers are the messages of an input.
template <class Role, class Advance, class Advanced>
class Puppet : public Role {
 public:
  Puppet(const std::uint8_t* data, std::size_t size) : conversation_(data, size) {}
  proto::Configured configure(const proto::Configure&) override { return answer<proto::Configured>(); }
  Advanced advance(const proto::Stamp&, const Advance&) override { return answer<Advanced>(); }
  proto::Accepted accept(const proto::Accept&) override { return answer<proto::Accepted>(); }
  void restore() override { answer<proto::Restored>(); }
  proto::Fields write(const proto::Write&) override { return answer<proto::Fields>(); }
  proto::State checkpoint() override { return answer<proto::State>(); }

 private:
  template <class Answer>
  Answer answer() {
    return conversation_.answer<Answer>();
  }
  Conversation conversation_;
};
using PuppetFluid = Puppet<proto::FluidParticipant, proto::FluidAdvance, proto::FluidAdvanced>;
using PuppetDem = Puppet<proto::DemParticipant, proto::DemAdvance, proto::DemAdvanced>;

/// The run ends well, or with an error.
inline void run(const char* text, Participants participants) {
  be_quiet();
  const scene::Scene scene = scene::read_text(text, "the scene of this target");
  const TemporaryFolder folder;
  Ledger ledger;
  try {
    Run run(scene, participants, folder.path(), 1, ledger);
    run.start({});
    run.march();
    log::info("the run ends well");
  } catch (const std::exception& e) {
    log::info("the run ends: {}", e.what());
  }
}

}  // namespace fpi::fuzz
