#include "coupling/quasi_newton.hpp"

#include <algorithm>
#include <utility>

namespace fpi::coupling {

void QuasiNewton::Column::forget(std::span<const Eigen::Index> rows) {
  for (const Eigen::Index row : rows) residual[row] = result[row] = 0;
}

void QuasiNewton::begin_step() {
  current_.clear();
  last_.reset();
  count_ = {};
}

QuasiNewton::Columns QuasiNewton::take_current() {
  Columns taken = std::exchange(current_, {});
  begin_step();
  return taken;
}

void QuasiNewton::forget(std::span<const Eigen::Index> rows) {
  for (Column& column : current_) column.forget(rows);
}

void QuasiNewton::learn(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) {
  Column now{residual, x + residual};
  if (last_) {
    Column column{now.residual - last_->residual, now.result - last_->result};
    if (column.residual.norm() > 0) current_.push_front(std::move(column));
  }
  last_ = std::move(now);
}

Eigen::VectorXd QuasiNewton::next(const Eigen::VectorXd& x, const Eigen::VectorXd& residual) {
  learn(x, residual);
  std::vector<const Column*> known;
  for (const Column& column : current_) known.push_back(&column);
  std::ranges::copy(earlier(), std::back_inserter(known));
  const Basis b = basis(known, x.size());
  count_ = {.kept = b.kept.size(), .dropped = known.size() - b.kept.size()};
  const Eigen::VectorXd along = b.Q.transpose() * residual;
  const Eigen::VectorXd alpha = b.R.triangularView<Eigen::Upper>().solve(along);
  return x + residual - b.results() * alpha - beyond(residual - b.Q * along);
}

QuasiNewton::Basis QuasiNewton::basis(const std::vector<const Column*>& columns, Eigen::Index size) {
  Basis b;
  const Eigen::Index most = std::min(size, static_cast<Eigen::Index>(columns.size()));
  b.Q.resize(size, most);
  b.R = Eigen::MatrixXd::Zero(most, most);
  Eigen::Index k = 0;
  for (const Column* column : columns) {
    if (k == most) break;
    Eigen::VectorXd q = column->residual, above = Eigen::VectorXd::Zero(k);
    for (int twice = 0; twice < 2; ++twice) {  // once more against round-off
      const Eigen::VectorXd part = b.Q.leftCols(k).transpose() * q;
      q -= b.Q.leftCols(k) * part;
      above += part;
    }
    const double left = q.norm();
    if (left <= filter * column->residual.norm()) continue;
    b.R.col(k).head(k) = above;
    b.R(k, k) = left;
    b.Q.col(k++) = q / left;
    b.kept.push_back(column);
  }
  b.Q.conservativeResize(size, k);
  b.R.conservativeResize(k, k);
  return b;
}

Eigen::MatrixXd QuasiNewton::Basis::results() const {
  Eigen::MatrixXd W(Q.rows(), Q.cols());
  for (std::size_t k = 0; k < kept.size(); ++k) W.col(static_cast<Eigen::Index>(k)) = kept[k]->result;
  return W;
}

}  // namespace fpi::coupling
