#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace fpi {
namespace {

int threads_asked() {
  const char* given = std::getenv("OMP_NUM_THREADS");
  const int asked = given ? std::atoi(given) : 0;
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Threads that wait for loops. A loop of a microsecond comes soon after the last, so they look out for a
/// while before they sleep.
class Team {
 public:
  ~Team() { dismiss(); }

  int size() const { return size_; }
  /// Sends the helpers home; the next loop hires as many as it takes.
  void resize(int n) {
    const std::lock_guard busy(in_use_);
    dismiss();
    size_ = std::max(1, n);
  }

  void run(int n, const std::function<void(int)>& work) {
    const std::unique_lock busy(in_use_, std::try_to_lock);
    if (!busy || n < 2 || size_ < 2) {
      for (int i = 0; i < n; ++i) work(i);
      return;
    }
    hire();
    work_ = &work;
    left_ = n;
    ticket_ = Ticket{static_cast<std::uint64_t>(n)} << 32;
    ++loop_;
    loop_.notify_all();
    share();
    while (left_ > 0) std::this_thread::yield();
  }

 private:
  using Ticket = std::uint64_t;  ///< number of pieces, then the next piece to take
  static constexpr Ticket piece_mask = 0xffffffff;
  static constexpr int glances = 2000;

  void hire() {
    try {
      while (static_cast<int>(helpers_.size()) + 1 < size_) {
        const unsigned seen = loop_;
        helpers_.emplace_back([this, seen] { help(seen); });
      }
    } catch (const std::system_error&) {
      // Where no further thread can be had, the ones there are do the work.
    }
  }
  void dismiss() {
    leaving_ = true;
    ++loop_;
    loop_.notify_all();
    helpers_.clear();
    leaving_ = false;
  }
  void help(unsigned seen) {
    while (true) {
      for (int i = 0; i < glances && loop_ == seen; ++i) std::this_thread::yield();
      loop_.wait(seen);
      seen = loop_;
      if (leaving_) return;
      share();
    }
  }
  /// Takes piece after piece. A helper that comes late finds nothing left, or the next loop's pieces: both
  /// numbers of a ticket change at once.
  void share() {
    for (Ticket ticket = ticket_; has_piece(ticket);) {
      if (!ticket_.compare_exchange_weak(ticket, ticket + 1)) continue;
      (*work_)(static_cast<int>(ticket & piece_mask));
      --left_;
      ticket = ticket_;
    }
  }
  static bool has_piece(Ticket ticket) { return (ticket & piece_mask) < ticket >> 32; }

  std::mutex in_use_;
  int size_ = threads_asked();
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<int> left_ = 0;  ///< pieces not done
  std::atomic<Ticket> ticket_ = 0;
  std::atomic<unsigned> loop_ = 0;
  std::atomic<bool> leaving_ = false;
  std::vector<std::jthread> helpers_;  ///< last, so that they leave first
};

Team& team() {
  static Team one;
  return one;
}

}  // namespace

int n_threads() { return team().size(); }

void use_threads(int n) { team().resize(n); }

void parallel_for(int n, const std::function<void(int)>& work) { team().run(n, work); }

}  // namespace fpi
