/// All arithmetic of time: the size of the next step, what happens to it when a step fails, succeeds or has
/// too large an error, and how the end and the output times are hit to the bit without a tiny step before
/// them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace fpi::coupling {

/// Estimate of a step's error in time.
struct TimeError {
  double value = 0;  ///< over the velocity
  double order = 0;  ///< power of Δt that it goes with; 0: no error is said
};

/// A quantity that the size of the steps is chosen by.
struct Demand {
  std::string_view what;  ///< its name, with the key of the scene that bounds it
  double excess = 0;      ///< of the step just tried, over what the scene allows
  double order = 1;       ///< power of Δt that it goes with
  double most = 2;        ///< a step with more excess is repeated
};

/// What is to be done with a step that converged.
enum class Verdict { take, repeat, take_at_smallest };

/// The way to the next output time (or the end) is divided into equal steps, none larger than the step in
/// force. That is `time.step`, or, where the scene lets it adapt, what the demands of the steps ask for: the
/// least of Δt/excess to the power 1/order, times 0.9; at most twice the last step, kept where it would
/// change by less than 20 % (so that factors of matrices keep as well). Where nothing is demanded, a halved
/// step grows back as without.
class TimeWindow {
 public:
  static constexpr int successes_to_regrow = 5;  ///< accepted steps before a halved step is doubled again

  /// `output_interval` [s]; 0: none.
  TimeWindow(const scene::Time& time, double output_interval);

  bool done() const { return start() >= end_; }
  double start() const { return time_after(taken_); }    ///< [s] where the next step begins
  double end() const { return time_after(taken_ + 1); }  ///< [s] where it ends
  double step() const { return step_; }  ///< [s] its size; the same bits for all steps to a target
  bool ends_at_output() const { return taken_ + 1 == count_; }
  std::int64_t steps_left() const;  ///< an estimate

  /// Before the first step, of bodies or a fluid that start with a velocity: errors of the first two steps
  /// are not known, and would be the largest of all. They are short where errors are bounded.
  void start_suddenly();
  /// Whether the step may be accepted. Where a demand is exceeded by too much it is to be repeated, and is
  /// smaller now, unless it is the smallest already.
  Verdict judge(std::span<const Demand> demands);
  /// The step was accepted.
  void accept(std::span<const Demand> demands = {});
  /// The step did not converge: it is halved. False where it was halved as often as allowed.
  bool halve();

  std::vector<double> state() const;
  /// Of a window that may have ended earlier.
  void set_state(std::span<const double> state);

 private:
  void plan(double from);
  double wanted_step(std::span<const Demand> demands) const;
  bool count_success();
  double next_target(double from) const;
  double time_after(std::int64_t steps) const {
    return steps == count_ ? target_ : anchor_ + static_cast<double>(steps) * step_;
  }

  double nominal_, end_, interval_;
  bool adapts_, bounds_error_;
  double smallest_, largest_allowed_;  ///< [s]
  int max_halvings_;
  double largest_;     ///< [s] step in force
  int halvings_ = 0;   ///< that are in force
  int successes_ = 0;  ///< since the last halving or doubling
  // count_ steps of size step_ from anchor_ to target_, of which taken_ are done
  double anchor_ = 0, target_ = 0, step_ = 0;
  std::int64_t taken_ = 0, count_ = 0;
};

}  // namespace fpi::coupling
