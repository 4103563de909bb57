/// A run of the coupler in this process, in which one participant says what an input says.
#pragma once

#include <map>

#include "../unit/temporary_folder.hpp"
#include "conversation.hpp"
#include "core/timer.hpp"
#include "proto/host.hpp"
#include "run/time_loop.hpp"
#include "scene/scene.hpp"

namespace fpi::fuzz {

/// A participant of a role that answers what the messages of an input say: of each type one after another,
/// and again from the first, so that a run with a few answers comes to its end.
template <class Role, class Advance, class Advanced>
class Puppet : public Role {
 public:
  Puppet(const std::uint8_t* data, std::size_t size) {
    Conversation conversation(data, size);
    while (auto envelope = conversation.next())
      answers_[envelope->message.index()].push_back(std::move(envelope->message));
  }
  proto::Configured configure(const proto::Configure&) override { return answer<proto::Configured>(); }
  Advanced advance(const proto::Stamp&, const Advance&) override { return answer<Advanced>(); }
  proto::Accepted accept(const proto::Accept&) override { return answer<proto::Accepted>(); }
  void restore() override { answer<proto::Restored>(); }
  proto::Fields write(const proto::Write&) override { return answer<proto::Fields>(); }
  proto::State checkpoint() override { return answer<proto::State>(); }

 private:
  template <class Answer>
  Answer answer() {
    static const std::size_t type = proto::Message(Answer{}).index();
    const std::vector<proto::Message>& all = answers_[type];
    if (all.empty()) throw proto::ParticipantLost("an answer of another type, or none");
    return std::get<Answer>(all[given_[type]++ % all.size()]);
  }

  std::map<std::size_t, std::vector<proto::Message>> answers_;  ///< by type
  std::map<std::size_t, std::size_t> given_;
};
using PuppetFluid = Puppet<proto::FluidParticipant, proto::FluidAdvance, proto::FluidAdvanced>;
using PuppetDem = Puppet<proto::DemParticipant, proto::DemAdvance, proto::DemAdvanced>;

/// The run ends well, or with an error.
inline void run(const char* text, Participants participants) {
  be_quiet();
  if (std::filesystem::is_directory("/dev/shm")) setenv("TMPDIR", "/dev/shm", 0);  // many files, soon gone
  const scene::Scene scene = scene::read_text(text, "the scene of this target");
  const TemporaryFolder folder;
  Timers timers;
  try {
    TimeLoop run(scene, participants, folder.path(), 1, timers);
    run.start({});
    run.march();
    log::info("the run ends well");
  } catch (const std::exception& e) {
    log::info("the run ends: {}", e.what());
  }
}

}  // namespace fpi::fuzz
