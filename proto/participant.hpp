/// What a solver implements to take part in a run; `serve` (serve.hpp) does all the rest: joining, heartbeats
/// from a thread of their own, checks of every message, errors, and the end. A toy fluid in under 100 lines:
/// tests/coupled.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "proto/connection.hpp"
#include "proto/messages.hpp"

namespace fpi::proto {

/// Common to all roles. A function may throw fpi::Error: the coupler is told who, in which phase and step,
/// and why.
class Participant {
 public:
  virtual ~Participant() = default;
  virtual Configured configure(const Configure&) = 0;
  /// Makes the last `advance` the state that the next ones start from, without the bodies that leave: they
  /// take no part any more and are named in no later message.
  virtual Accepted accept(const Accept&) = 0;
  /// Forgets every `advance` since the last `accept`, bitwise.
  virtual void restore() = 0;
  /// Fields for pictures; none by default.
  virtual Fields write(const Write&) { return {}; }
  /// All that is needed to continue to bitwise the same answer; caches that a resumed run would not have are
  /// dropped here too. A participant that offers it names the capability "checkpoint".
  virtual State checkpoint() { return {}; }
  /// Counters, timers [s] and the like, for the summary.
  virtual Figures report() { return {}; }

  Progress progress;
};

/// `advance` starts from the last accepted state each time. Sub-iteration 0 starts a step; sub-iteration k >
/// 0 may start its solution process from the result of k − 1. The same messages give bitwise the same
/// answers.
class FluidParticipant : public Participant {
 public:
  virtual FluidAdvanced advance(const Stamp&, const FluidAdvance&) = 0;
};
class DemParticipant : public Participant {
 public:
  virtual DemAdvanced advance(const Stamp&, const DemAdvance&) = 0;
};

/// The content of the file of that name among those sent. Throws Error where it is missing.
std::string_view content(const std::vector<File>& files, const std::string& name);

}  // namespace fpi::proto
