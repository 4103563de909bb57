/// Quasi-Newton that carries its inverse Jacobian from step to step (IQN-IMVJ; Lindner, Mehl, Scheufele &
/// Uekermann 2015), kept as a product of thin matrices so that hundreds of bodies stay cheap.
#pragma once

#include "coupling/quasi_newton.hpp"

namespace fpi::coupling {

/// J = (1 − first) I + A Bᵀ. An accepted step adds to it what its columns say anew, (W − J V) R⁻¹ Qᵀ. Where
/// A and B become wider than `most_columns`, the strongest half of their product's singular values stays
/// (restart by a truncated decomposition; Scheufele & Mehl 2017).
class IqnImvj : public QuasiNewton {
 public:
  static constexpr Eigen::Index most_columns = 60;
  static constexpr double weakest = 1e-6;  ///< singular value that is kept, over the largest

  /// `first`: what nothing is known of is relaxed by it.
  explicit IqnImvj(double first);

  void accept() override;
  void reject() override;
  void forget(std::span<const Eigen::Index> rows) override;
  ColumnCount columns() const override;
  std::vector<double> state() const override;
  void set_state(std::span<const double> state) override;

 protected:
  Eigen::VectorXd beyond(const Eigen::VectorXd& residual) const override;

 private:
  void compress();

  double first_;
  Eigen::MatrixXd A_, B_;
};

}  // namespace fpi::coupling
