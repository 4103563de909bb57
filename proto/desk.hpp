/// What a participant does with the requests that come: checks that the protocol allows them now, and lets
/// the solver answer.
#pragma once

#include <sys/resource.h>

#include <type_traits>
#include <variant>

#include "core/error.hpp"
#include "core/log.hpp"
#include "proto/codec.hpp"
#include "proto/interface_memory.hpp"
#include "proto/participant.hpp"

namespace fpi::proto {

inline double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Answers requests, in the order that the protocol allows.
template <class Solver, class Advance>
class Desk {
 public:
  explicit Desk(Solver& solver) : solver_(solver) {}

  Message answer(const Envelope& request) {
    solver_.progress.set(name(request.message));
    Message answer =
        std::visit([&](const auto& message) { return serve(request.stamp, message); }, request.message);
    solver_.progress.set("idle");
    return answer;
  }

 private:
  Message serve(const Stamp&, const Configure& configure) {
    require(!configured_, "a participant is configured once; got Configure again");
    configured_ = true;
    return solver_.configure(configure);
  }
  Message serve(const Stamp& stamp, const Advance& advance) {
    require_configured("an advance");
    advanced_ = true;
    if constexpr (std::is_same_v<Advance, FluidAdvance>)
      return solver_.advance(stamp, interfaces_.received(advance));
    else
      return solver_.advance(stamp, advance);
  }
  Message serve(const Stamp&, const Accept& accept) {
    require(advanced_, "Accept must follow an advance; got none since the last Accept or Restore");
    Accepted accepted = solver_.accept(accept);
    interfaces_.accept();
    advanced_ = false;
    return accepted;
  }
  Message serve(const Stamp&, const Restore&) {
    require_configured("Restore");
    solver_.restore();
    advanced_ = false;
    return Restored{};
  }
  Message serve(const Stamp&, const Write& write) {
    require_configured("Write");
    return solver_.write(write);
  }
  Message serve(const Stamp&, const Checkpoint&) {
    require_configured("Checkpoint");
    return solver_.checkpoint();
  }
  Message serve(const Stamp&, const Goodbye& goodbye) {
    log::info("the run is over: {}", goodbye.reason);
    Farewell farewell{solver_.report()};
    farewell.figures.emplace_back("peak_memory_bytes", peak_memory_bytes());
    return farewell;
  }
  template <class Other>
  Message serve(const Stamp&, const Other& other) {
    fail("a request for this role is required; got {}", name(other));
  }

  void require_configured(const char* what) const {
    require(configured_, "Configure must come before {}", what);
  }

  Solver& solver_;
  InterfaceMemory interfaces_;  // of a fluid
  bool configured_ = false, advanced_ = false;
};

}  // namespace fpi::proto
