#include "proto/interface_memory.hpp"

#include "core/error.hpp"

namespace fpi::proto {

FluidAdvance InterfaceMemory::sent(FluidAdvance message) {
  last_ = message.interfaces;
  message.same_interfaces = !last_.empty() && last_ == accepted_;
  if (message.same_interfaces) message.interfaces.clear();
  return message;
}

FluidAdvance InterfaceMemory::received(FluidAdvance message) {
  if (message.same_interfaces) {
    require(!accepted_.empty(),
            "interfaces must come with the first step before a later one can have the same; got none yet");
    message.interfaces = accepted_;
    message.same_interfaces = false;
  }
  last_ = message.interfaces;
  return message;
}

}  // namespace fpi::proto
