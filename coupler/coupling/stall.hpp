/// Whether a staggered iteration gets anywhere: residuals that no longer shrink, or that come back.
#pragma once

#include <Eigen/Core>
#include <deque>

namespace fpi::coupling {

enum class Stall { none, stagnation, cycle };

class StallWatch {
 public:
  static constexpr int patience = 6;       ///< sub-iterations without progress that are a stagnation
  static constexpr double progress = 0.9;  ///< the smallest residual must fall by this factor within them
  static constexpr std::size_t longest_cycle = 4;
  static constexpr double same = 1e-2;  ///< difference of residuals that come back, over their size

  /// The residual of one more sub-iteration, in the norm that convergence is measured in.
  Stall add(const Eigen::VectorXd& residual);
  void reset() { *this = {}; }

 private:
  bool comes_back(const Eigen::VectorXd& residual) const;

  double best_ = 0;                   ///< smallest norm that progress is counted from; 0: none yet
  int since_ = 0;                     ///< sub-iterations since
  int returns_ = 0;                   ///< sub-iterations in a row that one of the last few had already
  std::deque<Eigen::VectorXd> last_;  ///< newest first
};

}  // namespace fpi::coupling
