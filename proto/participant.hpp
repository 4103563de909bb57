/// What a solver implements to take part in a run; `serve` does all the rest: joining, heartbeats from a
/// thread of their own, checks of every message, errors, and the end. A toy fluid in under 100 lines:
/// tests/coupled.
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <vector>

#include "proto/messages.hpp"

namespace fpi::proto {

/// Where the solver says what it is doing; heartbeats carry it. Safe to call from the solving thread.
class Progress {
 public:
  /// `phase` must be a string literal.
  void set(const char* phase, double fraction = 0) {
    phase_.store(phase, std::memory_order_relaxed);
    fraction_.store(fraction, std::memory_order_relaxed);
  }
  const char* phase() const { return phase_.load(std::memory_order_relaxed); }
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }

 private:
  std::atomic<const char*> phase_{"start"};
  std::atomic<double> fraction_{0};
};

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

/// How a participant finds its coupler.
struct Connection {
  std::string program, program_version;
  std::vector<std::string> capabilities;
  std::string address;  ///< "tcp://127.0.0.1:5555"
  std::string keys;     ///< folder with participant.secret, participant.public, coupler.public; "": none
  std::string token;    ///< of the run; without keys only
  std::uint64_t scene_fingerprint = 0;  ///< 0: any scene
  double join_timeout = 30;             ///< [s] to wait for the coupler
};

/// Takes part in one run. Returns the exit status: 0 after a goodbye, 1 after an error of this participant, 2
/// where the coupler refused or could not be reached, 3 where it vanished; each is logged with a sentence. A
/// solver that still works 2 s after the run is over is ended with its process. Signals keep their default
/// meaning; the launcher starts participants with SIGINT ignored, since Ctrl-C reaches all and the coupler
/// ends them in order.
int serve(FluidParticipant&, const Connection&);
int serve(DemParticipant&, const Connection&);

/// The command line every participant shares:
///   --connect ADDRESS [--token FILE | --keys DIR] [--log FILE] [--scene FINGERPRINT] [--version]
/// Reads the token and opens the log. Exits by itself on --help, --version and bad options (status 2).
Connection read_command_line(int argc, char** argv, const std::string& program,
                             const std::vector<std::string>& capabilities);

}  // namespace fpi::proto
