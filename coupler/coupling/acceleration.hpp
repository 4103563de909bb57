/// How the next iterate of a step is found from the last and its residual. Iterates are scaled by inertia, so
/// that an acceleration sees plain vectors and nothing of bodies.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace fpi::coupling {

/// What was learnt of earlier iterates, as far as it is kept that way.
struct ColumnCount {
  std::size_t kept = 0;     ///< that the next iterate was found with
  std::size_t dropped = 0;  ///< that said nothing new
};

/// Order of calls: begin_step, then next after each sub-iteration but the last, finish after one that
/// converged, then accept or reject.
class Acceleration {
 public:
  virtual ~Acceleration() = default;
  virtual void begin_step() {}
  /// The next iterate, from x and r = H(x) − x.
  virtual Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) = 0;
  /// The iterate that converged.
  virtual void finish(const Eigen::VectorXd& /*x*/, const Eigen::VectorXd& /*residual*/) {}
  virtual void accept() {}
  virtual void reject() {}
  /// What was learnt about these unknowns no longer holds.
  virtual void forget(std::span<const Eigen::Index> /*rows*/) {}
  virtual ColumnCount columns() const { return {}; }
  /// What the following steps depend on, for a checkpoint taken between steps.
  virtual std::vector<double> state() const { return {}; }
  virtual void set_state(std::span<const double>) {}
};

}  // namespace fpi::coupling
