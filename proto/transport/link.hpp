/// A participant's end of the wire: a thread owns the socket, joins the run, sends heartbeats, and watches
/// the coupler, while the solver's thread works. The two meet in `next` and `answer`.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "proto/connection.hpp"
#include "proto/messages.hpp"
#include "proto/transport/pulse.hpp"
#include "proto/transport/socket.hpp"

namespace fpi::proto {

/// How a participant's run is over without a goodbye: exit status and reason.
struct Ending {
  int status;
  std::string reason;
};
using Event = std::variant<Envelope, Ending>;

class Link {
 public:
  /// Starts the thread, which connects. Throws Error for an unusable address or missing keys.
  Link(const Connection& connection, const std::string& role, const Progress& progress);
  /// Sends what is still to be sent and ends the thread.
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Waits for the next request; a Goodbye is one too.
  Event next();
  void answer(const Envelope& envelope);

 private:
  void run() noexcept;
  void turn();
  void forward_answers();
  void handle(const Frames& frames);
  void handle_event(const ConnectionEvent& event);
  void lose(const char* sign);
  std::string handshake_failure(const ConnectionEvent& event) const;
  void join();
  void beat();
  void watch_the_clock();
  void post(Event event);

  const Connection connection_;
  const std::string role_;
  const Progress& progress_;

  zmq::context_t context_;
  zmq::socket_t wire_{context_, ZMQ_DEALER};
  zmq::socket_t monitor_{context_, ZMQ_PAIR};  ///< what happens to the connection
  std::optional<Pulse> pulse_;                 ///< once the coupler has said how long it may be silent
  zmq::socket_t inner_{context_, ZMQ_PAIR};    ///< answers, the thread's end
  zmq::socket_t outer_{context_, ZMQ_PAIR};    ///< answers, the solver's end; an empty one is the last

  // Of the thread only.
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_beat_{};
  Stamp stamp_;                      ///< of the last request
  double heartbeat_interval_ = 0.5;  ///< [s]
  bool welcomed_ = false, stopped_ = false;
  std::optional<Clock::time_point> over_;  ///< since when the solver is asked to end
  int status_ = 0;                         ///< with which

  std::mutex mutex_;
  std::condition_variable posted_;
  std::deque<Event> events_;  ///< guarded by mutex_
  std::thread thread_;
};

}  // namespace fpi::proto
