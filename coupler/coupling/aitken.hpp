/// Aitken's dynamic relaxation in its vector form: one factor, found anew from the last two residuals
/// (Küttler & Wall 2008, eq. 44).
#pragma once

#include <optional>

#include "coupling/acceleration.hpp"

namespace fpi::coupling {

/// ω_k = −ω_{k−1} r_{k−1}·(r_k − r_{k−1}) / |r_k − r_{k−1}|², clamped to [smallest, largest]; the old factor
/// where the residuals are the same to round-off.
double aitken_factor(double factor_before, const Eigen::VectorXd& residual_before,
                     const Eigen::VectorXd& residual);

class Aitken : public Acceleration {
 public:
  static constexpr double smallest = 1e-3, largest = 2;

  /// `first`: the factor of the first sub-iteration of the first step. Later steps start from the last factor
  /// of the step before; a rejected step starts from `first` again.
  explicit Aitken(double first);

  void begin_step() override { residual_before_.reset(); }
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) override;
  void reject() override { factor_ = first_; }
  std::vector<double> state() const override { return {factor_}; }
  void set_state(std::span<const double> state) override { factor_ = state[0]; }
  double factor() const { return factor_; }

 private:
  double first_, factor_;
  std::optional<Eigen::VectorXd> residual_before_;
};

}  // namespace fpi::coupling
