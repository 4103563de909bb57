/// Interface quasi-Newton with an inverse Jacobian from least squares (Degroote, Bathe & Vierendeels 2009):
/// differences of residuals and of results, of this step and of the last few, say how the next iterate must
/// be chosen for the residual to vanish.
#pragma once

#include <deque>
#include <optional>

#include "coupling/acceleration.hpp"

namespace fpi::coupling {

class IqnIls : public Acceleration {
 public:
  static constexpr std::size_t reused_steps = 5;
  /// A column whose part that newer ones do not span is smaller than this is left out (QR2 filter of
  /// Haelterman et al. 2016).
  static constexpr double filter = 1e-2;

  /// `first`: the factor of an iterate without any column.
  explicit IqnIls(double first);

  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) override;
  void finish(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) override;
  void accept() override;
  void reject() override;
  std::vector<double> state() const override;
  void set_state(std::span<const double> state) override;

 private:
  /// r and x + r of an iterate, or the differences of two.
  struct Column {
    Eigen::VectorXd residual, result;
  };
  using Columns = std::deque<Column>;  ///< differences, newest first
  void learn(const Eigen::VectorXd& x, const Eigen::VectorXd& residual);

  double first_;
  Columns current_;             ///< of this step
  std::deque<Columns> before_;  ///< of accepted steps, newest first
  std::optional<Column> last_;  ///< iterate
};

}  // namespace fpi::coupling
