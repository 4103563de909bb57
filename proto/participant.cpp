/// The life of a participant: join, answer one request after another, leave.
#include "proto/participant.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <type_traits>

#include "core/error.hpp"
#include "core/log.hpp"
#include "proto/codec.hpp"
#include "proto/interface_memory.hpp"
#include "proto/transport/link.hpp"

namespace fpi::proto {
namespace {

double peak_memory_bytes() {
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

template <class Advance, class Solver>
int take_part(Solver& solver, const std::string& role, const Connection& connection) {
  constexpr int failed = 1, refused = 2;
  try {
    Link link(connection, role, solver.progress);
    Desk<Solver, Advance> desk(solver);
    for (;;) {
      const Event event = link.next();
      if (const auto* ending = std::get_if<Ending>(&event)) {
        log::error("{}", ending->reason);
        return ending->status;
      }
      const auto& request = std::get<Envelope>(event);
      try {
        link.answer({request.stamp, desk.answer(request)});
      } catch (const std::exception& e) {
        log::error("in phase \"{}\" of step {}: {}", solver.progress.phase(), request.stamp.step, e.what());
        link.answer({request.stamp, Failure{connection.program, solver.progress.phase(), e.what()}});
        return failed;
      }
      if (std::holds_alternative<Goodbye>(request.message)) return 0;
    }
  } catch (const std::exception& e) {
    log::error("{}", e.what());
    return refused;
  }
}

}  // namespace

std::string_view content(const std::vector<File>& files, const std::string& name) {
  const auto found = std::ranges::find(files, name, &File::name);
  require(found != files.end(),
          "the file {} is required, as the scene names it; it was not sent with the scene", name);
  return {reinterpret_cast<const char*>(found->bytes.data()), found->bytes.size()};
}

int serve(FluidParticipant& fluid, const Connection& connection) {
  return take_part<FluidAdvance>(fluid, "fluid", connection);
}
int serve(DemParticipant& dem, const Connection& connection) {
  return take_part<DemAdvance>(dem, "dem", connection);
}

}  // namespace fpi::proto
