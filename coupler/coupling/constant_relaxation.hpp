/// x + ω r with one factor for ever. Converges where every eigenvalue of 1 − ω(1 − H') lies in the unit
/// circle.
#pragma once

#include "core/error.hpp"
#include "coupling/acceleration.hpp"

namespace fpi::coupling {

class ConstantRelaxation : public Acceleration {
 public:
  explicit ConstantRelaxation(double factor) : factor_(factor) {
    require(factor > 0 && factor <= 2, "a relaxation factor in (0, 2] is required; got {}", factor);
  }
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) override {
    return x + factor_ * residual;
  }

 private:
  double factor_;
};

}  // namespace fpi::coupling
