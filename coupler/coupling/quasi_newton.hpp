/// Interface quasi-Newton: differences of residuals and of results of iterates say how the next iterate must
/// be chosen for the residual to vanish. What the differences do not span is left to the kinds of it.
#pragma once

#include <deque>
#include <optional>

#include "coupling/acceleration.hpp"

namespace fpi::coupling {

/// With columns V of differences of residuals and W of differences of results x + r, V = QR: the next iterate
/// is x + r − W R⁻¹ Qᵀ r − J (r − Q Qᵀ r), J the kind's own guess of d(x + r)/dr.
class QuasiNewton : public Acceleration {
 public:
  /// A column whose part that newer ones do not span is smaller than this is left out (QR2 filter of
  /// Haelterman et al. 2016).
  static constexpr double filter = 1e-2;

  void begin_step() override;
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) override;
  void finish(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) override { learn(x, residual); }
  void forget(std::span<const Eigen::Index> rows) override;
  ColumnCount columns() const override { return count_; }

 protected:
  /// r and x + r of an iterate, or the differences of two.
  struct Column {
    Eigen::VectorXd residual, result;
    void forget(std::span<const Eigen::Index> rows);
  };
  using Columns = std::deque<Column>;  ///< differences, newest first

  /// Columns made orthogonal one by one in the order of their age, those left out that say nothing new.
  struct Basis {
    std::vector<const Column*> kept;
    Eigen::MatrixXd Q, R;
    Eigen::MatrixXd results() const;  ///< W
  };
  static Basis basis(const std::vector<const Column*>& columns, Eigen::Index size);

  const Columns& current() const { return current_; }
  Columns take_current();
  /// Columns of earlier steps, newest first.
  virtual std::vector<const Column*> earlier() const { return {}; }
  /// J times what of the residual no column spans.
  virtual Eigen::VectorXd beyond(const Eigen::VectorXd& residual) const = 0;

 private:
  void learn(const Eigen::VectorXd& x, const Eigen::VectorXd& residual);

  Columns current_;             ///< of this step
  std::optional<Column> last_;  ///< iterate
  ColumnCount count_;
};

}  // namespace fpi::coupling
