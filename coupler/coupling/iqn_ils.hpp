/// Quasi-Newton with least squares over the differences of this step and of the last few (IQN-ILS; Degroote,
/// Bathe & Vierendeels 2009).
#pragma once

#include "coupling/quasi_newton.hpp"

namespace fpi::coupling {

class IqnIls : public QuasiNewton {
 public:
  static constexpr std::size_t reused_steps = 5;

  /// `first`: what no column spans is relaxed by it.
  explicit IqnIls(double first);

  void accept() override;
  void reject() override;
  void forget(std::span<const Eigen::Index> rows) override;
  std::vector<double> state() const override;
  void set_state(std::span<const double> state) override;

 protected:
  std::vector<const Column*> earlier() const override;
  Eigen::VectorXd beyond(const Eigen::VectorXd& residual) const override { return (1 - first_) * residual; }

 private:
  double first_;
  std::deque<Columns> before_;  ///< of accepted steps, newest first
};

}  // namespace fpi::coupling
