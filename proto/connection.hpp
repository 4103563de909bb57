/// A participant's end of the wire: how it finds its coupler, and what it says of itself meanwhile.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

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

}  // namespace fpi::proto
