/// Participants at the other end of the wire. They have the interface of a participant in this process, so
/// that the run does not know the difference.
#pragma once

#include <string>
#include <utility>

#include "core/timer.hpp"
#include "proto/host.hpp"
#include "proto/interface_memory.hpp"
#include "proto/participant.hpp"

namespace fpi {

/// What all roles share. `timers.seconds["waiting:ROLE"]` takes the time spent on answers.
template <class Role>
class Remote : public Role {
 public:
  Remote(proto::Host& host, std::string role, std::uint64_t run, Timers& timers)
      : host_(host), role_(std::move(role)), stamp_{.run = run}, timers_(timers) {}

  proto::Configured configure(const proto::Configure& message) override {
    return ask<proto::Configured>(message);
  }
  proto::Accepted accept(const proto::Accept& message) override { return ask<proto::Accepted>(message); }
  void restore() override { ask<proto::Restored>(proto::Restore{}); }
  proto::Fields write(const proto::Write& message) override { return ask<proto::Fields>(message); }
  proto::State checkpoint() override { return ask<proto::State>(proto::Checkpoint{}); }

 protected:
  template <class Answer>
  Answer advance_remotely(const proto::Stamp& stamp, proto::Message message) {
    stamp_ = stamp;
    return ask<Answer>(std::move(message));
  }

 private:
  template <class Answer>
  Answer ask(proto::Message message) {
    const ScopedTimer timer(timers_, ("waiting:" + role_).c_str());
    return host_.ask<Answer>(role_, stamp_, std::move(message));
  }

  proto::Host& host_;
  std::string role_;
  proto::Stamp stamp_;  ///< of the last advance
  Timers& timers_;
};

class RemoteFluid : public Remote<proto::FluidParticipant> {
 public:
  using Remote::Remote;
  proto::FluidAdvanced advance(const proto::Stamp& stamp, const proto::FluidAdvance& message) override {
    return advance_remotely<proto::FluidAdvanced>(stamp, interfaces_.sent(message));
  }
  proto::Accepted accept(const proto::Accept& message) override {
    proto::Accepted accepted = Remote::accept(message);
    interfaces_.accept();
    return accepted;
  }

 private:
  proto::InterfaceMemory interfaces_;
};

class RemoteDem : public Remote<proto::DemParticipant> {
 public:
  using Remote::Remote;
  proto::DemAdvanced advance(const proto::Stamp& stamp, const proto::DemAdvance& message) override {
    return advance_remotely<proto::DemAdvanced>(stamp, message);
  }
};

}  // namespace fpi
