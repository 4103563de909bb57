/// The life of a participant: join, answer one request after another, leave.
#include "proto/serve.hpp"

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/pages.hpp"
#include "core/text.hpp"
#include "proto/desk.hpp"
#include "proto/transport/link.hpp"

namespace fpi::proto {
namespace {

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
        link.answer({request.stamp, Failure{connection.program, solver.progress.phase(), legible(e.what())}});
        return failed;
      }
      if (std::holds_alternative<Goodbye>(request.message)) return 0;
      if (std::holds_alternative<Accept>(request.message)) return_pages_where_scarce();
    }
  } catch (const std::exception& e) {
    log::error("{}", e.what());
    return refused;
  }
}

}  // namespace

int serve(FluidParticipant& fluid, const Connection& connection) {
  return take_part<FluidAdvance>(fluid, "fluid", connection);
}
int serve(DemParticipant& dem, const Connection& connection) {
  return take_part<DemAdvance>(dem, "dem", connection);
}

}  // namespace fpi::proto
