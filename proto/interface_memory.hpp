/// Interfaces that stand still travel once: each end of the wire remembers those of the last accepted step,
/// so that a message may say "the same" (`same_interfaces`) and neither coupler nor fluid knows of it.
#pragma once

#include <vector>

#include "proto/messages.hpp"

namespace fpi::proto {

class InterfaceMemory {
 public:
  /// The message as it travels: without the interfaces where they are those of the last accepted step.
  FluidAdvance sent(FluidAdvance message);
  /// The message as the fluid wants it, with all interfaces. Throws Error where "the same" comes before any.
  FluidAdvance received(FluidAdvance message);
  /// The last step was accepted.
  void accept() { accepted_ = last_; }

 private:
  std::vector<Interface> accepted_, last_;
};

}  // namespace fpi::proto
